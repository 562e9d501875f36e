#include <perimorph/base/exceptions.h>
#include <perimorph/bonds/bond_search.h>
#include <perimorph/bonds/segment_cutter.h>
#include <perimorph/coupling/bond_set.h>
#include <perimorph/peridynamics/bond_based.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace Perimorph::Coupling
{
  namespace
  {
    /// Calibrated micromodulus of every node; the mean over the materials of
    /// the cells at the node.
    template <int dim>
    std::vector<double>
    nodal_micromodulus(const Mesh::NodalMesh<dim>      &mesh,
                       const std::vector<double>       &horizon,
                       const std::vector<BondMaterial> &materials)
    {
      // The factor depends on the ratio only, and ratios repeat.
      std::map<double, double> factors;
      std::vector<double>      result(mesh.n_nodes(), 0.);
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        {
          const auto cells = mesh.node_cells.row(n);
          for (const unsigned int c : cells)
            {
              const auto &material = materials[mesh.cell_material[c]];
              result[n] += Peridynamics::micromodulus(material.youngs_modulus,
                                                      horizon[n],
                                                      material.state) /
                           cells.size();
            }
          // Round the ratio so that round-off in the spacing does not make a
          // new lattice sum for every node.
          const double ratio =
            std::round(horizon[n] / mesh.spacing[n] * 1e6) / 1e6;
          auto known = factors.find(ratio);
          if (known == factors.end())
            known =
              factors
                .emplace(ratio, Peridynamics::calibration_factor<dim>(ratio))
                .first;
          result[n] *= known->second;
        }
      return result;
    }

    template <int dim>
    void
    check_neighbors(const Mesh::NodalMesh<dim>      &mesh,
                    const std::vector<double>       &alpha,
                    const std::vector<unsigned int> &n_bonds)
    {
      for (unsigned int n = mesh.owned_begin; n < mesh.owned_end; ++n)
        if (alpha[n] == 1. && n_bonds[n] < dim)
          {
            std::ostringstream where;
            where << "particle at (" << mesh.nodes[n] << ")";
            throw Base::InputError(
              Base::InputMessage{where.str(),
                                 std::to_string(n_bonds[n]) + " bonds",
                                 "at least " + std::to_string(dim),
                                 "Use a larger horizon ratio."});
          }
    }
  } // namespace

  template <int dim>
  BondCoupling<dim>
  make_bond_coupling(
    const Mesh::NodalMesh<dim>                          &mesh,
    const std::vector<double>                           &alpha,
    const std::vector<double>                           &horizon,
    const std::vector<BondMaterial>                     &materials,
    const bool                                           with_residual,
    const std::function<void(std::size_t, std::size_t)> &progress)
  {
    BondCoupling<dim> result;
    const auto micromodulus = nodal_micromodulus(mesh, horizon, materials);
    const auto pairs =
      Bonds::find_bond_pairs(mesh,
                             alpha,
                             horizon,
                             Bonds::BondSelection::of_this_rank);
    Bonds::SegmentCutter<dim>             cutter(mesh);
    SegmentResidual<dim>                  residual(mesh);
    std::vector<Bonds::SegmentPiece<dim>> pieces;
    std::vector<unsigned int>             n_bonds(mesh.n_nodes(), 0);
    for (std::size_t b = 0; b < pairs.size(); ++b)
      {
        const auto [i, j]   = pairs.nodes[b];
        const auto   xi     = mesh.nodes[j] - mesh.nodes[i];
        const double length = xi.norm();
        if (progress && b % 1000 == 0)
          progress(b, pairs.size());
        if (!cutter.cut(i, j, pieces))
          {
            result.bonds.n_dropped += pairs.owned[b] ? 1 : 0;
            continue;
          }
        const auto end = [&](const unsigned int n, const unsigned int k) {
          return Peridynamics::BondEnd{alpha[n],
                                       micromodulus[n],
                                       pairs.beta[b][k],
                                       mesh.volume[n]};
        };
        const double stiffness =
          Peridynamics::pair_stiffness(end(i, 0), end(j, 1), length);
        ++n_bonds[i];
        ++n_bonds[j];
        if (with_residual)
          residual.add_bond(xi / length, stiffness, length, pieces);
        if (pairs.owned[b])
          {
            result.bonds.nodes.push_back({{i, j}});
            result.bonds.stiffness.push_back(stiffness);
          }
      }
    if (with_residual)
      {
        residual.solve();
        result.cells = residual.touched_cells();
        for (std::size_t k = 0; k < result.cells.size(); ++k)
          result.tensors.push_back(residual.tensors(k));
      }
    check_neighbors(mesh, alpha, n_bonds);
    return result;
  }

  template BondCoupling<2>
  make_bond_coupling<2>(const Mesh::NodalMesh<2> &,
                        const std::vector<double> &,
                        const std::vector<double> &,
                        const std::vector<BondMaterial> &,
                        bool,
                        const std::function<void(std::size_t, std::size_t)> &);
  template BondCoupling<3>
  make_bond_coupling<3>(const Mesh::NodalMesh<3> &,
                        const std::vector<double> &,
                        const std::vector<double> &,
                        const std::vector<BondMaterial> &,
                        bool,
                        const std::function<void(std::size_t, std::size_t)> &);
} // namespace Perimorph::Coupling
