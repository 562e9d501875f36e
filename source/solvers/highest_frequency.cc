#include <perimorph/solvers/highest_frequency.h>

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

#include <cmath>

namespace Perimorph::Solvers
{
  namespace
  {
    /// M^-1/2 K M^-1/2.
    template <int dim>
    struct ScaledStiffness
    {
      const NodalForces<dim> &forces;
      const Vector           &scale; ///< M^-1/2, 0 where nothing is free
      const Vector           &displacement;
      mutable Vector          scaled;

      void
      vmult(Vector &product, const Vector &direction) const
      {
        scaled.zero_out_ghost_values();
        scaled = direction;
        scaled.scale(scale);
        forces.impose_hanging(scaled);
        forces.tangent_product(displacement, scaled, product);
        product.scale(scale);
      }
    };
  } // namespace

  template <int dim>
  double
  highest_frequency(const NodalForces<dim> &forces,
                    const Vector           &mass,
                    const Vector           &displacement)
  {
    // Enough that the largest eigenvalue is known to a tenth of a percent.
    constexpr unsigned int n_steps = 40;

    const auto &partition = forces.partition();
    Vector      scale, start, solution, scaled;
    for (auto *vector : {&scale, &start, &solution, &scaled})
      partition.initialize(*vector);
    for (unsigned int n = 0; n < partition.n_owned(); ++n)
      for (int d = 0; d < dim; ++d)
        {
          const unsigned int k = dim * n + d;
          if (mass.local_element(k) == 0.)
            continue;
          scale.local_element(k) = 1. / std::sqrt(mass.local_element(k));
          // Rough, and the same whatever the numbers of the nodes.
          double phase = 78.233 * (d + 1);
          for (int a = 0; a < dim; ++a)
            phase += (12.9898 + 24.1 * a) * partition.position(n)[a] /
                     (1e-3 + partition.position(n).norm());
          const double rough     = std::sin(phase) * 43758.5453;
          start.local_element(k) = rough - std::floor(rough) - 0.5;
        }
    if (start.l2_norm() == 0.)
      return 0.;

    double                         largest = 0.;
    dealii::IterationNumberControl control(n_steps, 1e-12 * start.l2_norm());
    dealii::SolverCG<Vector>       lanczos(control);
    lanczos.connect_eigenvalues_slot([&](const std::vector<double> &values) {
      if (!values.empty())
        largest = std::max(largest, values.back());
    });
    try
      {
        lanczos.solve(
          ScaledStiffness<dim>{forces, scale, displacement, std::move(scaled)},
          solution,
          start,
          dealii::PreconditionIdentity());
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        // No stiffness is left, or none along a direction: what was found
        // until then is all there is.
      }
    if (!(largest > 0.))
      return 0.;
    const double frequency = std::sqrt(largest);
    const double unit = std::pow(10., std::floor(std::log10(frequency)) - 5.);
    return unit * std::ceil(frequency / unit);
  }

  template double
  highest_frequency<2>(const NodalForces<2> &, const Vector &, const Vector &);
  template double
  highest_frequency<3>(const NodalForces<3> &, const Vector &, const Vector &);
} // namespace Perimorph::Solvers
