#pragma once

#include <perimorph/materials/material.h>

namespace Perimorph
{
  namespace Materials
  {
    /// Second Piola-Kirchhoff stress S = F^-1 P at H, extrapolated linearly
    /// along a step dH: S + dS/dH : dH.
    template <int dim>
    dealii::Tensor<2, dim>
    extrapolated_stress(const Material<dim>          &material,
                        const dealii::Tensor<2, dim> &H,
                        const dealii::Tensor<2, dim> &step);

    /// The tangent dP/dH at H with another stress S in its geometric part
    /// (identity (x) S).
    ///
    /// A Newton step that turns a slender body also stretches it in the linear
    /// measure of the step; the spurious stress at its end makes the next steps
    /// short. With the stress extrapolated from the start of the step the
    /// geometric part is that of the solution looked for, and the iterations
    /// are few (mixed integration points: Magisano, Leonetti, Garcea 2017).
    /// Where the iteration has converged both tangents are equal.
    template <int dim>
    dealii::Tensor<4, dim>
    tangent_with_stress(const Material<dim>          &material,
                        const dealii::Tensor<2, dim> &H,
                        const dealii::Tensor<2, dim> &S);
  } // namespace Materials
} // namespace Perimorph
