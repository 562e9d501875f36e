#include <perimorph/application/stability_advice.h>

#include <algorithm>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    /// Mean length of the edges of a cell along each of its directions.
    template <int dim>
    std::array<double, dim>
    mean_edges(const std::array<dealii::Point<dim>, (1u << dim)> &corners)
    {
      std::array<double, dim> result{};
      for (unsigned int v = 0; v < corners.size(); ++v)
        for (int d = 0; d < dim; ++d)
          if (!((v >> d) & 1u))
            result[d] += corners[v].distance(corners[v | (1u << d)]) /
                         double(corners.size() / 2);
      return result;
    }

    /// Warnings of one run.
    class Advice
    {
    public:
      template <typename Value>
      void
      add_if(const bool         wrong,
             const std::string &what,
             const Value       &value,
             const std::string &consequence)
      {
        if (!wrong)
          return;
        std::ostringstream text;
        text << what << " " << value << ": " << consequence;
        list.push_back(text.str());
      }

      std::vector<std::string> list;
    };
  } // namespace

  template <int dim>
  CellShapes
  peridynamic_cell_shapes(const Mesh::NodalMesh<dim> &mesh,
                          const Mesh::RegionMap      &region)
  {
    CellShapes shapes;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        double smallest = mesh.spacing[mesh.cells[c][0]], largest = smallest;
        bool   acts = false;
        for (const unsigned int n : mesh.cells[c])
          {
            acts     = acts || region.alpha[n] > 0.;
            smallest = std::min(smallest, mesh.spacing[n]);
            largest  = std::max(largest, mesh.spacing[n]);
          }
        if (!acts)
          continue;
        const auto edges      = mean_edges<dim>(mesh.corners(c));
        const auto [low, top] = std::minmax_element(edges.begin(), edges.end());
        shapes.aspect         = std::max(shapes.aspect, *top / *low);
        shapes.spacing_ratio =
          std::max(shapes.spacing_ratio, largest / smallest);
      }
    return shapes;
  }

  template <int dim>
  std::vector<std::string>
  stability_advice(const Mesh::NodalMesh<dim>         &mesh,
                   const Mesh::RegionMap              &region,
                   const Coupling::CouplingParameters &parameters,
                   const double                        poissons_ratio,
                   const bool                          finite_strain)
  {
    Advice advice;
    advice.add_if(poissons_ratio > 0.48,
                  "Poisson's ratio",
                  poissons_ratio,
                  "nearly incompressible, where finite elements of this kind "
                  "lock (displacements come out too small)");
    if (region.n_core + region.n_blending == 0)
      return advice.list;

    const bool   bonds  = parameters.model == Coupling::Model::bond_based;
    const double gamma  = parameters.gamma;
    const auto   shapes = peridynamic_cell_shapes(mesh, region);
    double       ratio  = 0.;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      if (region.alpha[n] > 0.)
        ratio = std::max(ratio, region.horizon[n] / mesh.spacing[n]);

    (void)bonds;
    (void)gamma;
    (void)finite_strain;
    (void)shapes;
    return advice.list;
  }

#define PERIMORPH_INSTANTIATE(dim)                         \
  template CellShapes peridynamic_cell_shapes<dim>(        \
    const Mesh::NodalMesh<dim> &,                          \
    const Mesh::RegionMap &);                              \
  template std::vector<std::string> stability_advice<dim>( \
    const Mesh::NodalMesh<dim> &,                          \
    const Mesh::RegionMap &,                               \
    const Coupling::CouplingParameters &,                  \
    double,                                                \
    bool);
  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
