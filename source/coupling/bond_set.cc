#include <perimorph/base/exceptions.h>
#include <perimorph/bonds/bond_search.h>
#include <perimorph/bonds/segment_cutter.h>
#include <perimorph/coupling/bond_set.h>
#include <perimorph/peridynamics/bond_based.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

namespace Perimorph::Coupling
{
  namespace
  {
    /// Calibrated micromodulus per unit of Young's modulus at the nodes that
    /// bonds ask for.
    template <int dim>
    class UnitMicromodulus
    {
    public:
      UnitMicromodulus(const Mesh::NodalMesh<dim> &mesh,
                       const std::vector<double>  &horizon,
                       const Materials::PlaneState state)
        : mesh(mesh)
        , horizon(horizon)
        , state(state)
      {}

      /// Zero at a finite-element node whose horizon is smaller than the
      /// spacing: it has no family of its own.
      double
      at(const unsigned int n)
      {
        if (horizon[n] < mesh.spacing[n] * (1. - 1e-8))
          return 0.;
        // Round the ratio so that round-off in the spacing does not make a new
        // lattice sum for every node.
        const double ratio =
          std::round(horizon[n] / mesh.spacing[n] * 1e6) / 1e6;
        auto known = factors.find(ratio);
        if (known == factors.end())
          known =
            factors.emplace(ratio, Peridynamics::calibration_factor<dim>(ratio))
              .first;
        return known->second *
               Peridynamics::micromodulus(1., horizon[n], state);
      }

    private:
      const Mesh::NodalMesh<dim> &mesh;
      const std::vector<double>  &horizon;
      const Materials::PlaneState state;
      std::map<double, double>    factors; ///< ratios repeat
    };

    /// Young's modulus of a bond by the materials it runs through; none for a
    /// bond that leaves its material although the elements can stand in for it
    /// (`drop_mixed`). A bond along an interface counts for the softer side,
    /// so that no element has to give more than it has.
    template <int dim>
    std::optional<double>
    bond_modulus(const Mesh::NodalMesh<dim>                  &mesh,
                 const std::vector<BondMaterial>             &materials,
                 const std::vector<Bonds::SegmentPiece<dim>> &pieces,
                 const bool                                   drop_mixed)
    {
      if (materials.size() == 1)
        return materials[0].youngs_modulus;
      // Pieces of one part come in a row, one per cell that shares it.
      std::vector<bool> covers(materials.size(), true);
      double            length = 0., compliance = 0.;
      for (std::size_t first = 0; first < pieces.size();)
        {
          const std::size_t n_shares = std::lround(1. / pieces[first].share);
          std::vector<bool> here(materials.size(), false);
          double            softest = std::numeric_limits<double>::max();
          for (std::size_t k = first; k < first + n_shares; ++k)
            {
              const unsigned int m = mesh.cell_material[pieces[k].cell];
              here[m]              = true;
              softest = std::min(softest, materials[m].youngs_modulus);
            }
          for (std::size_t m = 0; m < materials.size(); ++m)
            covers[m] = covers[m] && here[m];
          length += pieces[first].length;
          compliance += pieces[first].length / softest;
          first += n_shares;
        }
      double modulus = std::numeric_limits<double>::max();
      for (std::size_t m = 0; m < materials.size(); ++m)
        if (covers[m])
          modulus = std::min(modulus, materials[m].youngs_modulus);
      if (modulus < std::numeric_limits<double>::max())
        return modulus;
      if (drop_mixed)
        return std::nullopt;
      return length / compliance; // springs in a row
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
    const ElementShare                                   share,
    const std::function<void(std::size_t, std::size_t)> &progress)
  {
    BondCoupling<dim>     result;
    UnitMicromodulus<dim> micromodulus(mesh, horizon, materials[0].state);
    const auto            pairs =
      Bonds::find_bond_pairs(mesh,
                             alpha,
                             horizon,
                             Bonds::BondSelection::of_this_rank);
    Bonds::SegmentCutter<dim> cutter(mesh);
    SegmentResidual<dim>      residual(mesh);
    SegmentSprings<dim>       springs(mesh);
    const bool                with_residual = share != ElementShare::none;
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
        const auto modulus =
          bond_modulus(mesh, materials, pieces, with_residual);
        if (!modulus)
          continue;
        const auto end = [&](const unsigned int n, const unsigned int k) {
          const double beta = pairs.beta[b][k];
          return Peridynamics::BondEnd{alpha[n],
                                       beta > 0. ? *modulus * micromodulus.at(n)
                                                 : 0.,
                                       beta,
                                       mesh.volume[n]};
        };
        const double stiffness =
          Peridynamics::pair_stiffness(end(i, 0), end(j, 1), length);
        if (stiffness == 0.)
          continue;
        ++n_bonds[i];
        ++n_bonds[j];
        if (with_residual)
          residual.add_bond(xi / length, stiffness, length, pieces);
        if (share == ElementShare::springs)
          springs.add_bond(stiffness, length, pieces);
        if (pairs.owned[b])
          {
            result.bonds.nodes.push_back({{i, j}});
            result.bonds.stiffness.push_back(stiffness);
          }
      }
    if (with_residual)
      {
        residual.solve();
        if (share == ElementShare::springs)
          result.springs = springs.finish(residual);
      }
    if (share == ElementShare::tensors)
      {
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
                        ElementShare,
                        const std::function<void(std::size_t, std::size_t)> &);
  template BondCoupling<3>
  make_bond_coupling<3>(const Mesh::NodalMesh<3> &,
                        const std::vector<double> &,
                        const std::vector<double> &,
                        const std::vector<BondMaterial> &,
                        ElementShare,
                        const std::function<void(std::size_t, std::size_t)> &);
} // namespace Perimorph::Coupling
