#include <perimorph/bonds/bond_search.h>

#include <deal.II/base/exceptions.h>

#include <nanoflann.hpp>

#include <algorithm>
#include <limits>

namespace Perimorph
{
  namespace Bonds
  {
    namespace
    {
      /// Some nodes of the mesh as nanoflann wants to see them.
      template <int dim>
      struct NodeCloud
      {
        const std::vector<dealii::Point<dim>> &nodes;
        std::vector<unsigned int>              chosen;

        std::size_t
        kdtree_get_point_count() const
        {
          return chosen.size();
        }
        double
        kdtree_get_pt(const std::size_t k, const std::size_t axis) const
        {
          return nodes[chosen[k]][axis];
        }
        template <typename Box>
        bool
        kdtree_get_bbox(Box &) const
        {
          return false;
        }
      };

      template <int dim>
      using Tree = nanoflann::KDTreeSingleIndexAdaptor<
        nanoflann::L2_Simple_Adaptor<double, NodeCloud<dim>>,
        NodeCloud<dim>,
        dim,
        unsigned int>;

      /// Collects everything within a radius, in the interface nanoflann calls.
      class Collector
      {
      public:
        Collector(const double radius, std::vector<unsigned int> &found)
          : radius_square(radius * radius)
          , found(found)
        {}

        std::size_t
        size() const
        {
          return found.size();
        }
        bool
        full() const
        {
          return true;
        }
        bool
        addPoint(const double distance_square, const unsigned int k)
        {
          if (distance_square < radius_square)
            found.push_back(k);
          return true;
        }
        double
        worstDist() const
        {
          return radius_square;
        }

      private:
        double                     radius_square;
        std::vector<unsigned int> &found;
      };

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
      NodeCloud<dim> all{mesh.nodes, {}};
      NodeCloud<dim> weighted{mesh.nodes, {}};
      for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
        {
          all.chosen.push_back(node);
          if (alpha[node] > 0.)
            weighted.chosen.push_back(node);
        }
      BondPairs pairs;
      if (weighted.chosen.empty())
        return pairs;
      const Tree<dim> tree_of_all(dim, all);
      const Tree<dim> tree_of_weighted(dim, weighted);

      const bool     everything = selection == BondSelection::all;
      const Box<dim> rank_box =
        everything ? Box<dim>() : box_of_this_rank(mesh);

      std::vector<Found>        bonds;
      std::vector<unsigned int> neighbours;
      for (unsigned int i = 0; i < mesh.n_nodes(); ++i)
        {
          const double reach = horizon[i] + 0.5 * mesh.spacing[i];
          Box<dim>     reach_box;
          reach_box.include(mesh.nodes[i], reach);
          if (!everything && !reach_box.overlaps(rank_box))
            continue;

          const bool  has_weight = alpha[i] > 0.;
          const auto &tree       = has_weight ? tree_of_all : tree_of_weighted;
          const auto &cloud      = has_weight ? all : weighted;
          neighbours.clear();
          Collector collector(reach, neighbours);
          tree.radiusSearchCustomCallback(&mesh.nodes[i][0], collector);

          for (const unsigned int k : neighbours)
            {
              const unsigned int j = cloud.chosen[k];
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
                bonds.push_back({{{a, b}}, {{beta_j, beta_i}}});
            }
        }

      std::sort(bonds.begin(), bonds.end(), [](const Found &x, const Found &y) {
        return x.nodes < y.nodes;
      });
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
