#include <perimorph/base/exceptions.h>
#include <perimorph/fracture/stress_concentration.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Perimorph::Fracture
{
  namespace
  {
    bool
    smaller_coordinates(const std::vector<double> &a,
                        const std::vector<double> &b)
    {
      return std::lexicographical_compare(a.begin(),
                                          a.end(),
                                          b.begin(),
                                          b.end());
    }
  } // namespace

  template <int dim>
  StressConcentration<dim>
  stress_concentration(const Mesh::NodalMesh<dim>      &mesh,
                       const std::vector<unsigned int> &boundary_nodes,
                       const std::vector<Stress<dim>>  &stresses,
                       const double                     nominal_stress,
                       const std::string               &boundary_name,
                       const MPI_Comm                   communicator)
  {
    if (boundary_nodes.empty())
      throw Base::InputError(
        Base::InputMessage{"stress concentration on '" + boundary_name + "'",
                           "no nodes",
                           "a boundary of the mesh",
                           ""});
    if (!(std::abs(nominal_stress) > 0.) || !std::isfinite(nominal_stress))
      throw Base::InputError(
        Base::InputMessage{"nominal stress for the stress concentration on '" +
                             boundary_name + "'",
                           std::to_string(nominal_stress),
                           "a finite number other than 0",
                           ""});

    // In units of the nominal stress the largest value is wanted.
    const double        sign    = nominal_stress > 0. ? 1. : -1.;
    double              largest = -std::numeric_limits<double>::max();
    std::vector<double> owned(boundary_nodes.size(), largest);
    for (unsigned int n = 0; n < boundary_nodes.size(); ++n)
      if (mesh.owns_node(boundary_nodes[n]))
        {
          const auto principal = principal_stresses(stresses[n]);
          owned[n] = sign * (sign > 0. ? principal[0] : principal[2]);
          largest  = std::max(largest, owned[n]);
        }
    largest = dealii::Utilities::MPI::max(largest, communicator);

    // Candidate of this rank: coordinates, then node and stress.
    std::vector<double> candidate;
    const double        limit = largest - 1e-8 * std::abs(largest);
    for (unsigned int n = 0; n < boundary_nodes.size(); ++n)
      if (mesh.owns_node(boundary_nodes[n]) && owned[n] >= limit)
        {
          std::vector<double> entry;
          for (int d = 0; d < dim; ++d)
            entry.push_back(mesh.nodes[boundary_nodes[n]][d]);
          entry.push_back(boundary_nodes[n]);
          entry.push_back(sign * owned[n]);
          if (candidate.empty() || smaller_coordinates(entry, candidate))
            candidate = entry;
        }
    std::vector<double> best;
    for (const auto &entry :
         dealii::Utilities::MPI::all_gather(communicator, candidate))
      if (!entry.empty() && (best.empty() || smaller_coordinates(entry, best)))
        best = entry;

    StressConcentration<dim> result;
    for (int d = 0; d < dim; ++d)
      result.position[d] = best[d];
    result.node   = static_cast<unsigned int>(best[dim]);
    result.stress = best[dim + 1];
    result.value  = result.stress / nominal_stress;
    return result;
  }

  template <int dim>
  StressConcentration<dim>
  stress_concentration(const NodalStress<dim>          &recovery,
                       const std::vector<unsigned int> &boundary_nodes,
                       const std::vector<dealii::Tensor<1, dim>> &displacement,
                       const double       nominal_stress,
                       const std::string &boundary_name,
                       const MPI_Comm     communicator)
  {
    const auto              &mesh = recovery.fit().mesh();
    std::vector<Stress<dim>> stresses(boundary_nodes.size());
    for (unsigned int n = 0; n < boundary_nodes.size(); ++n)
      if (mesh.owns_node(boundary_nodes[n]))
        stresses[n] = recovery.at_node(boundary_nodes[n], displacement);
    return stress_concentration(mesh,
                                boundary_nodes,
                                stresses,
                                nominal_stress,
                                boundary_name,
                                communicator);
  }

#define INSTANTIATE(dim)                                       \
  template StressConcentration<dim> stress_concentration<dim>( \
    const Mesh::NodalMesh<dim> &,                              \
    const std::vector<unsigned int> &,                         \
    const std::vector<Stress<dim>> &,                          \
    double,                                                    \
    const std::string &,                                       \
    MPI_Comm);                                                 \
  template StressConcentration<dim> stress_concentration<dim>( \
    const NodalStress<dim> &,                                  \
    const std::vector<unsigned int> &,                         \
    const std::vector<dealii::Tensor<1, dim>> &,               \
    double,                                                    \
    const std::string &,                                       \
    MPI_Comm);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Perimorph::Fracture
