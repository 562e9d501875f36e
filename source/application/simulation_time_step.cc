#include <perimorph/application/motion_integrator.h>
#include <perimorph/application/simulation.h>
#include <perimorph/base/log.h>
#include <perimorph/fem/lumped_mass.h>
#include <perimorph/fem/nodal_values.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    constexpr double implicit_over_explicit = 10.;

    /// Steps after which the limit of stable steps may be found again.
    constexpr unsigned int limit_interval = 100;

    /// Finite strain: steps after which gradients of the displacement are
    /// looked at, and by how much a change of theirs lowers the limit at most
    /// (Hencky's law pressed to half: 2.6). The limit itself is found again
    /// once short steps have cost about as much as that does.
    constexpr unsigned int gradient_interval  = 5;
    constexpr double       limit_per_gradient = 2.5, steps_worth_a_limit = 150.;

    /// Largest difference of two fields' difference between nodes of a cell
    /// over their distance, of all ranks.
    template <int dim>
    double
    gradient_change(const Mesh::NodalMesh<dim>                &mesh,
                    const std::vector<dealii::Tensor<1, dim>> &before,
                    const std::vector<dealii::Tensor<1, dim>> &now,
                    const MPI_Comm                             communicator)
    {
      double largest = 0.;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (mesh.owns_cell(c))
          {
            const auto &nodes = mesh.cells[c];
            const auto  first = now[nodes[0]] - before[nodes[0]];
            for (unsigned int v = 1; v < nodes.size(); ++v)
              largest =
                std::max(largest,
                         (now[nodes[v]] - before[nodes[v]] - first).norm() /
                           mesh.nodes[nodes[v]].distance(mesh.nodes[nodes[0]]));
          }
      return dealii::Utilities::MPI::max(largest, communicator);
    }
  } // namespace

  template <int dim>
  double
  Simulation<dim>::longest_time_step(const MotionIntegrator<dim> &integrator,
                                     const Method                &method)
  {
    const auto &time        = parameters.time_integration;
    const bool  is_explicit = time.scheme == TimeScheme::explicit_motion;
    if (stable_time_step == 0. && (is_explicit || time.time_step == 0.))
      {
        const auto   timer   = timing.scope("time_step_limit");
        const double earlier = announced_limit;
        stable_time_step     = integrator.stable_time_step(method.motion);
        // A body in pieces that nothing holds together has no limit.
        if (earlier > 0. && !std::isfinite(stable_time_step))
          stable_time_step = earlier;
        if (is_explicit &&
            std::abs(stable_time_step - earlier) > 0.05 * earlier)
          {
            log << "Stability limit of explicit steps at t = "
                << method.motion.time << ": " << stable_time_step << std::endl;
            announced_limit = stable_time_step;
          }
      }
    if (is_explicit && time.time_step > stable_time_step)
      {
        std::ostringstream text;
        text << "the limit of stable time steps is " << stable_time_step
             << " now; 'Time integration / time step' is " << time.time_step;
        throw Base::SolveError(text.str());
      }
    return time.time_step > 0.
             ? time.time_step
             : time.safety_factor * stable_time_step *
                 (is_explicit ? 1. / limit_reduction : implicit_over_explicit);
  }

  template <int dim>
  bool
  Simulation<dim>::limit_may_have_changed(const Method &method)
  {
    ++steps_of_limit;
    if (method.equilibrium->is_linear())
      {
        if (!limit_is_old || steps_of_limit < limit_interval)
          return false;
      }
    else
      {
        if (steps_of_limit % gradient_interval != 0)
          return false;
        auto now = Fem::to_nodal_values(method.motion.displacement,
                                        method.problem->partition());
        limit_reduction =
          1. + limit_per_gradient * gradient_change(mesh->nodal(),
                                                    displacement_of_limit,
                                                    now,
                                                    communicator);
        steps_lost += gradient_interval * (limit_reduction - 1.);
        if (steps_lost < steps_worth_a_limit &&
            parameters.time_integration.time_step * limit_reduction <=
              stable_time_step)
          return true;
        displacement_of_limit = std::move(now);
      }
    stable_time_step = 0.;
    limit_is_old     = false;
    limit_reduction  = 1.;
    steps_lost       = 0.;
    steps_of_limit   = 0;
    return true;
  }

  template <int dim>
  void
  Simulation<dim>::check_time_step()
  {
    const auto &time = parameters.time_integration;
    if (time.scheme != TimeScheme::explicit_motion || time.time_step == 0.)
      return;
    Method method = set_up(parameters.region.mode);
    node_mass     = Fem::lumped_mass(mesh->nodal(), materials.density);
    const auto limit =
      make_integrator(method)->stable_time_step(initial_motion(method));
    if (time.time_step <= limit)
      return;
    std::ostringstream found, allowed;
    found << time.time_step;
    allowed << "at most " << limit << ", the stability limit of this mesh";
    throw Base::InputError(
      Base::InputMessage{"parameter 'Time integration / time step'",
                         found.str(),
                         allowed.str(),
                         "0 chooses it."});
  }

#define PERIMORPH_INSTANTIATE(dim)                                       \
  template double Simulation<dim>::longest_time_step(                    \
    const MotionIntegrator<dim> &,                                       \
    const Method &);                                                     \
  template bool Simulation<dim>::limit_may_have_changed(const Method &); \
  template void Simulation<dim>::check_time_step();
  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
