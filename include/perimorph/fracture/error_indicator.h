#pragma once

#include <perimorph/fracture/displacement_fit.h>
#include <perimorph/fracture/nodal_stress.h>

#include <vector>

namespace Perimorph::Fracture
{
  /// Error of finite elements in the energy norm, from the difference between
  /// their displacement gradient and that of the fitted displacement.
  /// Source: O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Meth. Engng. 24
  /// (1987) 337-357, equation (5) with the fit as the smooth field.
  struct ErrorIndicator
  {
    std::vector<double> squares;     ///< of each cell [energy]; others zero
    double              energy = 0.; ///< twice the strain energy of these cells

    /// Error of all cells over the norm of the solution.
    double
    relative_error() const;
  };

  /// For the cells whose nodes all have alpha = 0; stiffness of the rest state.
  template <int dim>
  ErrorIndicator
  estimate_error(const DisplacementFit<dim>                &fit,
                 const MaterialList<dim>                   &materials,
                 const std::vector<double>                 &alpha,
                 const std::vector<dealii::Tensor<1, dim>> &displacement);

  /// The fewest cells that have this fraction of the sum of squares; of cells
  /// with the same indicator all (symmetric bodies stay symmetric).
  /// Source: W. Doerfler, SIAM J. Numer. Anal. 33 (1996) 1106-1124.
  std::vector<unsigned int>
  cells_with_most_error(const ErrorIndicator &indicator, double fraction);
} // namespace Perimorph::Fracture
