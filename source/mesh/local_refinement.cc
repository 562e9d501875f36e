#include <perimorph/base/exceptions.h>
#include <perimorph/mesh/boundary_curves.h>
#include <perimorph/mesh/cell_geometry.h>
#include <perimorph/mesh/local_refinement.h>

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace Perimorph::Mesh
{
  namespace
  {
    template <int dim>
    typename GmshMesh<dim>::Face
    sorted(typename GmshMesh<dim>::Face face)
    {
      std::sort(face.begin(), face.end());
      return face;
    }

    /// Parents that hang themselves are replaced by theirs.
    void
    resolve(HangingPoints &hanging)
    {
      for (auto &[point, parents] : hanging)
        for (bool changed = true; changed;)
          {
            changed = false;
            std::map<unsigned int, double> weights;
            for (const auto &[parent, weight] : parents)
              {
                const auto found = hanging.find(parent);
                changed          = changed || found != hanging.end();
                if (found == hanging.end())
                  weights[parent] += weight;
                else
                  for (const auto &[other, factor] : found->second)
                    weights[other] += weight * factor;
              }
            parents.assign(weights.begin(), weights.end());
          }
    }
  } // namespace

  template <int dim>
  class LocalRefinement<dim>::Tree
  {
  public:
    using Triangulation = dealii::Triangulation<dim>;
    using Cell          = typename Triangulation::cell_iterator;
    /// Groups of each side of a cell.
    using SideGroups = std::array<std::vector<unsigned int>,
                                  dealii::GeometryInfo<dim>::faces_per_cell>;

    Tree(const GmshMesh<dim> &coarse, const bool find_curves)
      : coarse(coarse)
      , triangulation(Triangulation::limit_level_difference_at_vertices)
    {
      std::vector<dealii::CellData<dim>> cells(coarse.cells.size());
      for (unsigned int c = 0; c < cells.size(); ++c)
        cells[c].vertices.assign(coarse.cells[c].begin(),
                                 coarse.cells[c].end());
      dealii::GridTools::consistently_order_cells(cells);
      triangulation.create_triangulation(coarse.points,
                                         cells,
                                         dealii::SubCellData());
      find_groups();
      if (find_curves)
        attach_curves();
      find_leaves();
    }

    void
    refine(const std::vector<unsigned int> &cells)
    {
      for (const unsigned int c : cells)
        leaves[c].cell->set_refine_flag();
      triangulation.execute_coarsening_and_refinement();
      find_leaves();
    }

    GmshMesh<dim>
    mesh() const;

    std::vector<std::string> curves, unknown_curves;

  private:
    struct Leaf
    {
      Cell         cell;
      unsigned int coarse;
      SideGroups   groups;
    };

    void
    find_groups()
    {
      std::map<typename GmshMesh<dim>::Face, std::vector<unsigned int>> of_face;
      for (const auto &[name, faces] : coarse.surfaces)
        {
          for (const auto &face : faces)
            of_face[sorted<dim>(face)].push_back(names.size());
          names.push_back(name);
        }
      groups.resize(triangulation.n_cells(0));
      for (const auto &cell : triangulation.cell_iterators_on_level(0))
        for (const unsigned int f : cell->face_indices())
          {
            const auto found = of_face.find(sorted<dim>(points_of(cell, f)));
            if (found != of_face.end())
              groups[cell->index()][f] = found->second;
          }
    }

    void
    attach_curves()
    {
      std::map<typename GmshMesh<dim>::Face, unsigned int> id_of_face;
      unsigned int                                         id = 0;
      for (const auto &curve : find_boundary_curves(coarse))
        {
          if (!curve.manifold)
            {
              unknown_curves.push_back(curve.boundary);
              continue;
            }
          curves.push_back("'" + curve.boundary + "' is " + curve.description);
          triangulation.set_manifold(++id, *curve.manifold);
          for (const auto &face : curve.faces)
            id_of_face[sorted<dim>(face)] = id;
        }
      std::sort(unknown_curves.begin(), unknown_curves.end());
      unknown_curves.erase(
        std::unique(unknown_curves.begin(), unknown_curves.end()),
        unknown_curves.end());
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          {
            const auto found = id_of_face.find(sorted<dim>(points_of(cell, f)));
            if (found != id_of_face.end())
              cell->face(f)->set_all_manifold_ids(found->second);
          }
    }

    void
    find_leaves()
    {
      leaves.clear();
      for (const auto &cell : triangulation.cell_iterators_on_level(0))
        add_leaves(cell, cell->index(), groups[cell->index()]);
    }

    void
    add_leaves(const Cell        &cell,
               const unsigned int coarse_cell,
               const SideGroups  &sides)
    {
      if (cell->is_active())
        {
          leaves.push_back({cell, coarse_cell, sides});
          return;
        }
      // Children are numbered like vertices.
      for (unsigned int child = 0; child < cell->n_children(); ++child)
        {
          SideGroups of_child;
          for (unsigned int f = 0; f < of_child.size(); ++f)
            if (((child >> (f / 2)) & 1u) == f % 2)
              of_child[f] = sides[f];
          add_leaves(cell->child(child), coarse_cell, of_child);
        }
    }

    static typename GmshMesh<dim>::Face
    points_of(const Cell &cell, const unsigned int f)
    {
      typename GmshMesh<dim>::Face face;
      for (unsigned int v = 0; v < face.size(); ++v)
        face[v] = cell->face(f)->vertex_index(v);
      return face;
    }

    HangingPoints
    hanging_points() const;

    const GmshMesh<dim>      coarse;
    Triangulation            triangulation;
    std::vector<std::string> names;  ///< of the groups of faces
    std::vector<SideGroups>  groups; ///< of the coarse cells
    std::vector<Leaf>        leaves;
  };

  template <int dim>
  HangingPoints
  LocalRefinement<dim>::Tree::hanging_points() const
  {
    HangingPoints hanging;
    const auto    add_line = [&hanging](const auto &line) {
      if (line->has_children())
        hanging[line->child(0)->vertex_index(1)] = {
          {line->vertex_index(0), 0.5},
          {line->vertex_index(1), 0.5}};
    };
    for (const auto &leaf : leaves)
      {
        if constexpr (dim == 2)
          for (const unsigned int f : leaf.cell->face_indices())
            add_line(leaf.cell->face(f));
        else
          {
            for (const unsigned int l : leaf.cell->line_indices())
              add_line(leaf.cell->line(l));
            for (const unsigned int f : leaf.cell->face_indices())
              if (leaf.cell->face(f)->has_children())
                {
                  auto &parents =
                    hanging[leaf.cell->face(f)->child(0)->vertex_index(3)];
                  parents.clear();
                  for (unsigned int v = 0; v < 4; ++v)
                    parents.emplace_back(leaf.cell->face(f)->vertex_index(v),
                                         0.25);
                }
          }
      }
    resolve(hanging);
    return hanging;
  }

  template <int dim>
  GmshMesh<dim>
  LocalRefinement<dim>::Tree::mesh() const
  {
    GmshMesh<dim> mesh;
    mesh.drawn   = coarse.drawn;
    mesh.points  = triangulation.get_vertices();
    mesh.hanging = hanging_points();
    // Curved sides are straight where a coarse cell sees them.
    for (const auto &[point, parents] : mesh.hanging)
      {
        dealii::Point<dim> mean;
        for (const auto &[parent, weight] : parents)
          mean += weight * mesh.points[parent];
        mesh.points[point] = mean;
      }

    std::vector<std::vector<unsigned int>> children(coarse.cells.size());
    for (const auto &name : names)
      mesh.surfaces[name];
    std::set<typename GmshMesh<dim>::Face> interior; // seen from one side
    for (const auto &[cell, coarse_cell, sides] : leaves)
      {
        children[coarse_cell].push_back(mesh.cells.size());
        mesh.cells.emplace_back();
        std::array<dealii::Point<dim>, (1u << dim)> corners;
        for (unsigned int v = 0; v < corners.size(); ++v)
          {
            mesh.cells.back()[v] = cell->vertex_index(v);
            corners[v]           = mesh.points[cell->vertex_index(v)];
          }
        if (smallest_relative_jacobian<dim>(corners) <= 0.)
          {
            std::ostringstream found;
            found << "a cell at (" << cell->center()
                  << ") that is not convex once it is refined";
            throw Base::InputError(Base::InputMessage{
              "section 'Mesh / Refinement'",
              found.str(),
              "a coarse mesh that resolves curved boundaries",
              "Use smaller cells there, or 'curved boundaries = straight'."});
          }
        for (const unsigned int f : cell->face_indices())
          {
            const auto face = points_of(cell, f);
            if (cell->face(f)->has_children() ||
                (!cell->at_boundary(f) && cell->neighbor_is_coarser(f)))
              mesh.hanging_faces.push_back(face);
            if (sides[f].empty() || cell->face(f)->has_children())
              continue;
            if (!cell->at_boundary(f) &&
                !interior.insert(sorted<dim>(face)).second)
              continue;
            for (const unsigned int group : sides[f])
              mesh.surfaces[names[group]].push_back(face);
          }
      }
    for (const auto &[name, cells] : coarse.volumes)
      for (const unsigned int c : cells)
        mesh.volumes[name].insert(mesh.volumes[name].end(),
                                  children[c].begin(),
                                  children[c].end());
    return mesh;
  }

  template <int dim>
  LocalRefinement<dim>::LocalRefinement(const GmshMesh<dim> &coarse,
                                        const bool           find_curves)
    : tree(std::make_unique<Tree>(coarse, find_curves))
  {}

  template <int dim>
  LocalRefinement<dim>::~LocalRefinement() = default;

  template <int dim>
  const std::vector<std::string> &
  LocalRefinement<dim>::curves() const
  {
    return tree->curves;
  }

  template <int dim>
  const std::vector<std::string> &
  LocalRefinement<dim>::unknown_curves() const
  {
    return tree->unknown_curves;
  }

  template <int dim>
  void
  LocalRefinement<dim>::refine(const std::vector<unsigned int> &cells)
  {
    tree->refine(cells);
  }

  template <int dim>
  GmshMesh<dim>
  LocalRefinement<dim>::mesh() const
  {
    return tree->mesh();
  }

  template class LocalRefinement<2>;
  template class LocalRefinement<3>;
} // namespace Perimorph::Mesh
