#include <perimorph/base/exceptions.h>
#include <perimorph/solvers/dynamic_relaxation.h>

#include <algorithm>
#include <cmath>

namespace Perimorph::Solvers
{
  template <int dim>
  DynamicRelaxation<dim>::DynamicRelaxation(
    NodalForces<dim>           &forces,
    const RelaxationParameters &parameters)
    : forces(forces)
    , parameters(parameters)
  {
    forces.partition().initialize(mass);
    forces.partition().initialize(inverse_mass);
  }

  template <int dim>
  void
  DynamicRelaxation<dim>::find_mass(const Vector &displacement)
  {
    // By Gershgorin's circles the frequencies of K / m with m_i = sum_j |K_ij|
    // / 4 do not exceed 2, the limit of steps of length 1.
    constexpr double margin = 1.1;
    mass.zero_out_ghost_values();
    mass = 0.;
    displacement.update_ghost_values();
    std::vector<unsigned int>  nodes;
    dealii::FullMatrix<double> tangent;
    for (const auto *term : forces.coupled_problem().terms())
      for (unsigned int block = 0; block < term->n_blocks(); ++block)
        {
          term->block_nodes(block, nodes);
          term->block_tangent(block, displacement, tangent);
          for (unsigned int k = 0; k < nodes.size(); ++k)
            for (int d = 0; d < dim; ++d)
              {
                double sum = 0.;
                for (unsigned int l = 0; l < dim * nodes.size(); ++l)
                  sum += std::abs(tangent(dim * k + d, l));
                mass.begin()[dim * nodes[k] + d] += 0.25 * margin * sum;
              }
        }
    mass.compress(dealii::VectorOperation::add);
    displacement.zero_out_ghost_values();
    forces.condense(mass);
    inverse_mass = mass;
    for (unsigned int k = 0; k < mass.locally_owned_size(); ++k)
      if (mass.local_element(k) > 0.)
        inverse_mass.local_element(k) = 1. / mass.local_element(k);
  }

  template <int dim>
  NewtonRecord
  DynamicRelaxation<dim>::solve(
    const double                                        time,
    Vector                                             &displacement,
    const std::function<void(const NewtonIteration &)> &report)
  {
    constexpr unsigned int mass_interval = 1000, report_interval = 5000;

    displacement.zero_out_ghost_values();
    const Vector start  = displacement;
    const bool   linear = forces.coupled_problem().is_linear();
    Vector       velocity, residual, first_residual, moved, moved_from, change,
      weighted;
    for (auto *vector : {&velocity,
                         &residual,
                         &first_residual,
                         &moved,
                         &moved_from,
                         &change,
                         &weighted})
      forces.partition().initialize(*vector);
    NewtonRecord record;
    double       first = 0.;
    try
      {
        forces.impose_supports(time, displacement);
        forces.impose_hanging(displacement);
        if (!linear || mass.l2_norm() == 0.)
          find_mass(displacement);
        for (unsigned int step = 0;; ++step)
          {
            if (!linear && step > 0 && step % mass_interval == 0)
              find_mass(displacement);
            forces.evaluate(time, displacement);
            const Vector earlier = residual;
            residual             = forces.external();
            residual -= forces.internal();
            double reactions = 0.;
            for (const unsigned int k : forces.held())
              reactions += std::pow(residual.local_element(k), 2);
            reactions = std::sqrt(
              dealii::Utilities::MPI::sum(reactions,
                                          forces.partition().communicator()));
            forces.condense(residual);
            const double norm = residual.l2_norm();
            if (!std::isfinite(norm))
              throw Base::SolveError("the relaxation has no finite residual");
            if (step == 0)
              {
                first          = norm;
                first_residual = residual;
                moved_from     = displacement;
              }
            largest_force =
              std::max({largest_force, first, forces.external().l2_norm()});
            const double scale    = std::max(largest_force, reactions);
            const double relative = scale > 0. ? norm / scale : 0.;
            const bool   is_done  = relative <= parameters.tolerance;
            if (step % report_interval == 0 || is_done)
              {
                report({static_cast<unsigned int>(record.residuals.size()),
                        norm,
                        relative,
                        1.,
                        step - record.linear_iterations});
                record.residuals.push_back(relative);
                record.linear_iterations = step;
              }
            if (is_done)
              {
                record.converged = true;
                return record;
              }
            if (step == parameters.maximum_steps)
              throw Base::SolveError("no equilibrium after " +
                                     std::to_string(step) +
                                     " steps of the relaxation");

            // Squared frequencies: stiffness over mass along a field.
            double damping = 0.;
            if (step > 0)
              {
                double     lowest   = 4.;
                const auto quotient = [&](const Vector &field,
                                          const double  energy) {
                  weighted = field;
                  weighted.scale(mass);
                  const double inertia = weighted * field;
                  if (inertia > 0. && energy > 0.)
                    lowest = std::min(lowest, energy / inertia);
                };
                change = earlier;
                change -= residual;
                quotient(velocity, velocity * change);
                moved = displacement;
                moved -= moved_from;
                // The force of the motion since the start: what the residual
                // has lost.
                change = first_residual;
                change -= residual;
                quotient(moved, moved * change);
                damping = 2. * std::sqrt(lowest);
              }
            for (unsigned int k = 0; k < velocity.locally_owned_size(); ++k)
              {
                const double kick =
                  inverse_mass.local_element(k) * residual.local_element(k);
                velocity.local_element(k) =
                  step == 0
                    ? 0.5 * kick
                    : ((2. - damping) * velocity.local_element(k) + 2. * kick) /
                        (2. + damping);
              }
            displacement += velocity;
            forces.impose_hanging(displacement);
          }
      }
    catch (const Base::SolveError &error)
      {
        record.converged = false;
        record.reason    = error.what();
      }
    displacement.zero_out_ghost_values();
    displacement = start;
    return record;
  }

  template class DynamicRelaxation<2>;
  template class DynamicRelaxation<3>;
} // namespace Perimorph::Solvers
