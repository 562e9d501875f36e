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
                   const std::pair<double, double>    &poissons_ratios,
                   const bool                          finite_strain)
  {
    Advice advice;
    advice.add_if(poissons_ratios.second > 0.48,
                  "Poisson's ratio",
                  poissons_ratios.second,
                  "nearly incompressible, where finite elements of this kind "
                  "lock (displacements come out too small)");
    if (region.n_core + region.n_blending == 0)
      return advice.list;

    const auto shapes = peridynamic_cell_shapes(mesh, region);
    double     ratio  = 0.;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      if (region.alpha[n] > 0.)
        ratio = std::max(ratio, region.horizon[n] / mesh.spacing[n]);

    if (parameters.model == Coupling::Model::bond_based)
      {
        // No element stands behind the bonds at the surface of the body.
        const bool alone = region.n_blending + region.n_elements == 0;
        advice.add_if(shapes.aspect > 2.3,
                      "bonds on cells with an aspect ratio of",
                      shapes.aspect,
                      "the stiffness may be indefinite and the result wrong, "
                      "above all in compression. Use cells with a ratio below "
                      "2.3, or model = correspondence");
        advice.add_if(finite_strain && alone && ratio > 2.5,
                      "bonds everywhere with a horizon ratio of",
                      ratio,
                      "they may lose stability in compression. Use a ratio of "
                      "2, or Mode = coupled with elements at the surface");
        return advice.list;
      }
    const bool wide = has_wide_gradients(parameters);
    advice.add_if(dim == 3 && wide && poissons_ratios.first < -0.25,
                  "families with Poisson's ratio",
                  poissons_ratios.first,
                  "the stabilisation makes coarse meshes too stiff in bending; "
                  "compare with a finer mesh");
    advice.add_if(dim == 3 && wide && ratio < 2.5 &&
                    influence_function_of(parameters, mesh, region) ==
                      Peridynamics::InfluenceFunction::cubic_spline,
                  "influence function cubic spline in 3D with a horizon ratio "
                  "of",
                  ratio,
                  "too narrow, bending becomes too stiff; use gaussian or a "
                  "ratio of 3");
    const double gamma = parameters.gamma;
    advice.add_if(gamma < 0.25,
                  "parameter 'Peridynamics / stabilization'",
                  gamma,
                  "zero-energy modes are not held; 1 fits all");
    advice.add_if(gamma > 1.5,
                  "parameter 'Peridynamics / stabilization'",
                  gamma,
                  "bending becomes too stiff; 1 fits all");
    advice.add_if(wide && ratio > 3.01,
                  "families with a horizon ratio of",
                  ratio,
                  "wrong stiffness in bending unless the body is much thicker "
                  "than the horizon; usual value: 2");
    advice.add_if(!wide && finite_strain && ratio > 3.01,
                  "families at finite strain with a horizon ratio of",
                  ratio,
                  "Newton's method may fail in compression; usual value: 2");
    advice.add_if(shapes.aspect > 2.5 &&
                    (wide || region.n_blending + region.n_elements > 0),
                  "families on cells with an aspect ratio of",
                  shapes.aspect,
                  "bending along the long sides may be wrong: elements beside "
                  "them lock, and so do families in 3D whose gradient support "
                  "is the horizon. Use cells with a ratio below 2.5");
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
    const std::pair<double, double> &,                     \
    bool);
  PERIMORPH_INSTANTIATE(2)
  PERIMORPH_INSTANTIATE(3)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Application
