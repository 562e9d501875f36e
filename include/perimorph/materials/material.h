#pragma once

#include <deal.II/base/tensor.h>

#include <string>

namespace Perimorph
{
  namespace Materials
  {
    /// A hyperelastic law at one material point, used by finite-element
    /// quadrature points and peridynamic particles alike.
    ///
    /// F is the deformation gradient [-], P the first Piola-Kirchhoff stress
    /// and A its derivative [stress, in the units of Young's modulus].
    /// Small-strain laws read the displacement gradient as F - I.
    template <int dim>
    class Material
    {
    public:
      virtual ~Material() = default;

      virtual std::string
      name() const = 0;

      /// True when P is linear in F - I: one factorisation solves the problem.
      virtual bool
      is_linear() const = 0;

      /// Stored energy per reference volume W(F).
      virtual double
      energy_density(const dealii::Tensor<2, dim> &F) const = 0;

      /// P = dW/dF.
      virtual dealii::Tensor<2, dim>
      first_piola_kirchhoff(const dealii::Tensor<2, dim> &F) const = 0;

      /// A[i][J][k][L] = dP[i][J] / dF[k][L].
      virtual dealii::Tensor<4, dim>
      tangent(const dealii::Tensor<2, dim> &F) const = 0;

      /// Normal stress across the plane of a 2D model (zero in plane stress and
      /// meaningless, zero, in 3D).
      virtual double
      out_of_plane_stress(const dealii::Tensor<2, dim> &F) const = 0;

      /// Shear modulus at rest, the scale of the zero-energy stabilisation.
      virtual double
      shear_modulus() const = 0;
    };
  } // namespace Materials
} // namespace Perimorph
