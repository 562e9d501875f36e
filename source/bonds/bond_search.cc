#include <perimorph/base/point_cloud.h>
#include <perimorph/bonds/bond_search.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace Perimorph
{
  namespace Bonds
  {
    namespace
    {
      template <int dim>
      struct Box
      {
        dealii::Point<dim> lower;
        dealii::Point<dim> upper;

        Box()
        {
          for (int d = 0; d < dim; ++d)
            {
              lower[d] = std::numeric_limits<double>::max();
              upper[d] = -std::numeric_limits<double>::max();
            }
        }

        void
        include(const dealii::Point<dim> &point, const double margin = 0.)
        {
          for (int d = 0; d < dim; ++d)
            {
              lower[d] = std::min(lower[d], point[d] - margin);
              upper[d] = std::max(upper[d], point[d] + margin);
            }
        }

        bool
        overlaps(const Box &other) const
        {
          for (int d = 0; d < dim; ++d)
            if (lower[d] > other.upper[d] || other.lower[d] > upper[d])
              return false;
          return true;
        }
      };

      /// Box of the cells and nodes of this rank, a little enlarged: bonds
      /// along its sides belong to it.
      template <int dim>
      Box<dim>
      box_of_this_rank(const Mesh::NodalMesh<dim> &mesh)
      {
        Box<dim> box;
        for (unsigned int node = mesh.owned_begin; node < mesh.owned_end;
             ++node)
          box.include(mesh.nodes[node], 1e-6 * mesh.spacing[node]);
        for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
          if (mesh.owns_cell(cell))
            for (const unsigned int node : mesh.cells[cell])
              box.include(mesh.nodes[node], 1e-6 * mesh.spacing[node]);
        return box;
      }

      struct Found
      {
        std::array<unsigned int, 2> nodes;
        std::array<double, 2>       beta;
      };
    } // namespace

    double
    volume_factor(const double horizon,
                  const double spacing,
                  const double length)
    {
      const double factor = (horizon + 0.5 * spacing - length) / spacing;
      return factor < 1e-10 ? 0. : std::min(factor, 1.);
    }

    template <int dim>
    BondPairs
    find_bond_pairs(const Mesh::NodalMesh<dim> &mesh,
                    const std::vector<double>  &alpha,
                    const std::vector<double>  &horizon,
                    const BondSelection         selection)
    {
      AssertDimension(alpha.size(), mesh.n_nodes());
      AssertDimension(horizon.size(), mesh.n_nodes());

      // A node without weight only bonds with nodes that have some: it asks the
      // second tree, which is empty or far away for most nodes of a large mesh.
      std::vector<unsigned int>       weighted_nodes;
      std::vector<dealii::Point<dim>> weighted_points;
      for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
        if (alpha[node] > 0.)
          {
            weighted_nodes.push_back(node);
            weighted_points.push_back(mesh.nodes[node]);
          }
      BondPairs pairs;
      if (weighted_nodes.empty())
        return pairs;
      const Base::PointCloud<dim> all(mesh.nodes);
      const Base::PointCloud<dim> weighted(std::move(weighted_points));

      const bool     everything = selection == BondSelection::all;
      const Box<dim> rank_box =
        everything ? Box<dim>() : box_of_this_rank(mesh);

      // The first come in rising order.
      std::vector<Found>        bonds, seen_from_second;
      std::vector<unsigned int> neighbours;
      for (unsigned int i = 0; i < mesh.n_nodes(); ++i)
        {
          const double reach = horizon[i] + 0.5 * mesh.spacing[i];
          Box<dim>     reach_box;
          reach_box.include(mesh.nodes[i], reach);
          if (!everything && !reach_box.overlaps(rank_box))
            continue;

          const bool has_weight = alpha[i] > 0.;
          (has_weight ? all : weighted)
            .within(mesh.nodes[i], reach, neighbours);

          for (const unsigned int k : neighbours)
            {
              const unsigned int j = has_weight ? k : weighted_nodes[k];
              if (j == i)
                continue;
              const unsigned int a = std::min(i, j);
              const unsigned int b = std::max(i, j);

              const double length = mesh.nodes[a].distance(mesh.nodes[b]);
              const double beta_i =
                volume_factor(horizon[i], mesh.spacing[i], length);
              const double beta_j =
                volume_factor(horizon[j], mesh.spacing[j], length);
              // A bond both ends can see is taken from its first node.
              if (beta_i == 0. || (beta_j > 0. && j < i))
                continue;

              if (!everything && !mesh.owns_node(a))
                {
                  Box<dim> segment_box;
                  segment_box.include(mesh.nodes[a]);
                  segment_box.include(mesh.nodes[b]);
                  if (!segment_box.overlaps(rank_box))
                    continue;
                }
              if (a == i)
                bonds.push_back({{{a, b}}, {{beta_i, beta_j}}});
              else
                seen_from_second.push_back({{{a, b}}, {{beta_j, beta_i}}});
            }
        }

      const auto by_nodes = [](const Found &x, const Found &y) {
        return x.nodes < y.nodes;
      };
      std::sort(seen_from_second.begin(), seen_from_second.end(), by_nodes);
      const std::size_t n_first = bonds.size();
      bonds.insert(bonds.end(),
                   seen_from_second.begin(),
                   seen_from_second.end());
      std::inplace_merge(bonds.begin(),
                         bonds.begin() + n_first,
                         bonds.end(),
                         by_nodes);
      pairs.nodes.reserve(bonds.size());
      pairs.beta.reserve(bonds.size());
      pairs.owned.reserve(bonds.size());
      for (const Found &bond : bonds)
        {
          pairs.nodes.push_back(bond.nodes);
          pairs.beta.push_back(bond.beta);
          pairs.owned.push_back(mesh.owns_node(bond.nodes[0]));
        }
      return pairs;
    }

    template BondPairs
    find_bond_pairs<2>(const Mesh::NodalMesh<2> &,
                       const std::vector<double> &,
                       const std::vector<double> &,
                       BondSelection);
    template BondPairs
    find_bond_pairs<3>(const Mesh::NodalMesh<3> &,
                       const std::vector<double> &,
                       const std::vector<double> &,
                       BondSelection);
  } // namespace Bonds
} // namespace Perimorph
