#include <perimorph/base/exceptions.h>
#include <perimorph/base/point_cloud.h>
#include <perimorph/bonds/bond_search.h>
#include <perimorph/bonds/segment_cutter.h>
#include <perimorph/coupling/bond_set.h>
#include <perimorph/coupling/cut_residual.h>
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
    /// First radius of the least-squares fits next to cracks over the spacing.
    /// It acts on the length of the tip: 2.5 was fitted to mode I in the plane
    /// (numerics-cracks.md, section 6). In space the fit would be too wide.
    template <int dim>
    constexpr double fit_radius = dim == 2 ? 2.5 : 1.8;

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
        , values(mesh.n_nodes(), -1.)
      {}

      /// Zero at a finite-element node whose horizon is smaller than the
      /// spacing: it has no family of its own.
      double
      at(const unsigned int n)
      {
        if (values[n] < 0.)
          values[n] = compute(n);
        return values[n];
      }

    private:
      double
      compute(const unsigned int n)
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

      const Mesh::NodalMesh<dim> &mesh;
      const std::vector<double>  &horizon;
      const Materials::PlaneState state;
      std::vector<double>         values;  ///< of the nodes asked for, or -1
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

    /// What the couplings of this file are made from.
    template <int dim>
    struct BondSource
    {
      const Mesh::NodalMesh<dim>      &mesh;
      const std::vector<double>       &alpha;
      const std::vector<double>       &horizon;
      const std::vector<BondMaterial> &materials;
      const Bonds::CrackSet<dim>      &cracks;
      const bool                       with_residual;
      Bonds::SegmentCutter<dim>        cutter;
      UnitMicromodulus<dim>            micromodulus;

      // Of the last bond.
      std::vector<Bonds::SegmentPiece<dim>> pieces;
      dealii::Tensor<1, dim>                xi;
      double                                stiffness = 0.;

      enum class Outcome
      {
        bond,
        none,      ///< no stiffness
        left_body, ///< hole or notch
        cut_by_crack
      };

      Outcome
      make(const Bonds::BondPairs &pairs, const std::size_t b)
      {
        const auto [i, j] = pairs.nodes[b];
        if (cracks.crosses(mesh.nodes[i], mesh.nodes[j]))
          return Outcome::cut_by_crack;
        if (!cutter.cut(i, j, pieces))
          return Outcome::left_body;
        const auto modulus =
          bond_modulus(mesh, materials, pieces, with_residual);
        if (!modulus)
          return Outcome::none;
        const auto end = [&](const unsigned int n, const unsigned int k) {
          const double beta = pairs.beta[b][k];
          return Peridynamics::BondEnd{alpha[n],
                                       beta > 0. ? *modulus * micromodulus.at(n)
                                                 : 0.,
                                       beta,
                                       mesh.volume[n]};
        };
        xi = mesh.nodes[j] - mesh.nodes[i];
        stiffness =
          Peridynamics::pair_stiffness(end(i, 0), end(j, 1), xi.norm());
        return stiffness == 0. ? Outcome::none : Outcome::bond;
      }
    };

    /// All bonds that may run through cells or end at their nodes, whoever owns
    /// them.
    template <int dim>
    Bonds::BondPairs
    pairs_of_cells(const Mesh::NodalMesh<dim>      &mesh,
                   const std::vector<double>       &alpha,
                   const std::vector<double>       &horizon,
                   const std::vector<unsigned int> &cells)
    {
      double reach = 0.;
      for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
        reach = std::max(reach, horizon[n] + 0.5 * mesh.spacing[n]);
      const Base::PointCloud<dim> cloud(mesh.nodes);
      std::vector<double>         near_alpha(mesh.n_nodes(), 0.);
      std::vector<unsigned int>   near;
      for (const unsigned int c : cells)
        {
          // Both ends of a bond are as near to each of its points as it is
          // long.
          double radius = 0.;
          for (const unsigned int n : mesh.cells[c])
            radius =
              std::max(radius, mesh.nodes[n].distance(mesh.cell_centroid[c]));
          cloud.within(mesh.cell_centroid[c], reach + radius, near);
          for (const unsigned int n : near)
            near_alpha[n] = alpha[n];
        }
      return Bonds::find_bond_pairs(mesh,
                                    near_alpha,
                                    horizon,
                                    Bonds::BondSelection::all);
    }

    double
    bond_shear_modulus(const BondMaterial &material)
    {
      return Materials::lame_constants(
               material.youngs_modulus,
               Peridynamics::allowed_poissons_ratio(material.state),
               material.state)
        .mu;
    }

    /// The parts and tensors next to cracks, on top of those of the other
    /// cells.
    template <int dim>
    void
    add_cut_residual(BondSource<dim>      &source,
                     const CellParts<dim> &parts,
                     BondCoupling<dim>    &result)
    {
      const auto                            &mesh = source.mesh;
      std::vector<FullySymmetricTensor<dim>> stiffness;
      for (const auto &material : source.materials)
        stiffness.push_back(
          isotropic_tensor<dim>(bond_shear_modulus(material)));
      CutResidual<dim> residual(mesh,
                                source.horizon,
                                source.cracks,
                                parts,
                                stiffness,
                                fit_radius<dim>);
      const auto       pairs =
        pairs_of_cells(mesh, source.alpha, source.horizon, residual.cells());
      using Outcome = typename BondSource<dim>::Outcome;
      std::vector<bool> has_cut_bond(mesh.n_nodes(), false);
      for (std::size_t b = 0; b < pairs.size(); ++b)
        {
          const auto outcome = source.make(pairs, b);
          if (outcome == Outcome::bond)
            residual.add_bond(pairs.nodes[b],
                              source.xi / source.xi.norm(),
                              source.stiffness,
                              source.xi.norm(),
                              source.pieces);
          else if (outcome == Outcome::cut_by_crack)
            for (const unsigned int n : pairs.nodes[b])
              has_cut_bond[n] = true;
        }
      residual.solve();

      for (std::size_t p = 0; p < parts.parts().size(); ++p)
        if (mesh.owns_cell(parts.parts()[p].cell))
          {
            result.parts.push_back(parts.parts()[p]);
            result.part_tensors.push_back(residual.part_tensors()[p]);
          }
      std::map<unsigned int, std::size_t> position;
      for (std::size_t k = 0; k < result.cells.size(); ++k)
        position[result.cells[k]] = k;
      for (const auto &[cell, of_points] : residual.cell_tensors())
        if (mesh.owns_cell(cell))
          {
            const auto [entry, is_new] =
              position.emplace(cell, result.cells.size());
            if (is_new)
              {
                result.cells.push_back(cell);
                result.tensors.emplace_back();
              }
            result.tensors[entry->second] = of_points;
          }
      result.cracked.n_cut =
        std::count(has_cut_bond.begin(), has_cut_bond.end(), true);
      result.cracked.residual = residual.residual();
      result.cracked.nodes    = residual.target_nodes();
    }

    /// @param excused  particles that may have fewer
    template <int dim>
    void
    check_neighbors(const Mesh::NodalMesh<dim>      &mesh,
                    const std::vector<double>       &alpha,
                    const std::vector<unsigned int> &n_bonds,
                    const std::vector<bool>         &excused)
    {
      for (unsigned int n = mesh.owned_begin; n < mesh.owned_end; ++n)
        if (alpha[n] == 1. && n_bonds[n] < dim && !excused[n])
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
    const std::function<void(std::size_t, std::size_t)> &progress,
    const Bonds::CrackSet<dim>                          &cracks,
    const CrackRule                                      rule)
  {
    BondCoupling<dim> result;
    const bool        with_residual = share != ElementShare::none;
    BondSource<dim>   source{mesh,
                           alpha,
                           horizon,
                           materials,
                           cracks,
                           with_residual,
                           Bonds::SegmentCutter<dim>(mesh),
                           {mesh, horizon, materials[0].state},
                           {},
                           {}};
    using Outcome = typename BondSource<dim>::Outcome;
    const auto pairs =
      Bonds::find_bond_pairs(mesh,
                             alpha,
                             horizon,
                             Bonds::BondSelection::of_this_rank);
    std::optional<CellParts<dim>> parts;
    if (share == ElementShare::springs && rule == CrackRule::consistent &&
        !cracks.empty())
      throw Base::InputError(Base::InputMessage{
        "parameter 'Cracks / pre-cracks'",
        "cracks in bond-based peridynamics with the consistent rule for cut "
        "bonds and the finite-strain law 'prototype microelastic'",
        "the law 'linear elastic', the correspondence model, or 'Cracks / "
        "treatment' = "
        "shape tensor",
        "The stiffness next to cracks is exact at small strain only."});
    if (with_residual && !cracks.empty())
      {
        parts.emplace(mesh, cracks, fit_radius<dim>);
        result.replaced.resize(mesh.n_cells());
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          result.replaced[c] = parts->is_touched(c);
      }

    SegmentResidual<dim>      residual(mesh);
    SegmentSprings<dim>       springs(mesh);
    std::vector<unsigned int> n_bonds(mesh.n_nodes(), 0);
    std::vector<bool>         has_cut_bond(mesh.n_nodes(), false);
    for (std::size_t b = 0; b < pairs.size(); ++b)
      {
        const auto [i, j] = pairs.nodes[b];
        if (progress && b % 1000 == 0)
          progress(b, pairs.size());
        const auto outcome = source.make(pairs, b);
        if (outcome == Outcome::left_body)
          result.bonds.n_dropped += pairs.owned[b] ? 1 : 0;
        if (outcome == Outcome::cut_by_crack)
          has_cut_bond[i] = has_cut_bond[j] = true;
        if (outcome != Outcome::bond)
          continue;
        ++n_bonds[i];
        ++n_bonds[j];
        const double length = source.xi.norm();
        if (pairs.owned[b])
          {
            result.bonds.nodes.push_back({{i, j}});
            result.bonds.stiffness.push_back(source.stiffness);
          }
        auto &pieces = source.pieces;
        if (parts)
          pieces.erase(std::remove_if(pieces.begin(),
                                      pieces.end(),
                                      [&](const auto &piece) {
                                        return parts->is_touched(piece.cell);
                                      }),
                       pieces.end());
        if (with_residual)
          residual.add_bond(source.xi / length,
                            source.stiffness,
                            length,
                            pieces);
        if (share == ElementShare::springs)
          springs.add_bond(source.stiffness, length, pieces);
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
        if (parts && rule == CrackRule::consistent)
          add_cut_residual(source, *parts, result);
      }
    check_neighbors(mesh, alpha, n_bonds, has_cut_bond);
    return result;
  }

#define PERIMORPH_INSTANTIATE(dim)                         \
  template BondCoupling<dim> make_bond_coupling<dim>(      \
    const Mesh::NodalMesh<dim> &,                          \
    const std::vector<double> &,                           \
    const std::vector<double> &,                           \
    const std::vector<BondMaterial> &,                     \
    ElementShare,                                          \
    const std::function<void(std::size_t, std::size_t)> &, \
    const Bonds::CrackSet<dim> &,                          \
    CrackRule);

  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Coupling
