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
    /// All functions take the displacement gradient H = grad u [-]; a
    /// finite-strain law forms F = I + H itself. (From F alone the strain would
    /// carry the round-off of I: a relative error of 1e-16 / |H|.) P is the
    /// first Piola-Kirchhoff stress and A its derivative [stress, in the units
    /// of Young's modulus].
    ///
    /// A finite-strain law throws Base::InadmissibleState from each of these
    /// functions where it has no answer: J = det F <= 0 or not finite, or no
    /// stress-free thickness in plane stress.
    template <int dim>
    class Material
    {
    public:
      virtual ~Material() = default;

      virtual std::string
      name() const = 0;

      /// True when P is linear in H: one factorisation solves the problem.
      virtual bool
      is_linear() const = 0;

      /// Stored energy per reference volume W.
      virtual double
      energy_density(const dealii::Tensor<2, dim> &H) const = 0;

      /// P = dW/dH = dW/dF.
      virtual dealii::Tensor<2, dim>
      first_piola_kirchhoff(const dealii::Tensor<2, dim> &H) const = 0;

      /// A[i][J][k][L] = dP[i][J] / dH[k][L].
      virtual dealii::Tensor<4, dim>
      tangent(const dealii::Tensor<2, dim> &H) const = 0;

      /// Normal stress across the plane of a 2D model (zero in plane stress and
      /// meaningless, zero, in 3D); the first Piola-Kirchhoff component P33 of
      /// a finite-strain law.
      virtual double
      out_of_plane_stress(const dealii::Tensor<2, dim> &H) const = 0;

      /// Stretch F33 of the thickness [-]: 1 in plane strain and 3D; in plane
      /// stress that of the law (1 + e33 of a small-strain law).
      virtual double
      out_of_plane_stretch(const dealii::Tensor<2, dim> &H) const = 0;

      /// Shear modulus at rest, the scale of the zero-energy stabilisation.
      virtual double
      shear_modulus() const = 0;
    };
  } // namespace Materials
} // namespace Perimorph
