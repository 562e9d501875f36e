#include <perimorph/fracture/error_indicator.h>
#include <perimorph/mesh/cell_geometry.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace Perimorph::Fracture
{
  double
  ErrorIndicator::relative_error() const
  {
    const double sum = std::accumulate(squares.begin(), squares.end(), 0.);
    return sum > 0. ? std::sqrt(sum / (energy + sum)) : 0.;
  }

  template <int dim>
  ErrorIndicator
  estimate_error(const DisplacementFit<dim>                &fit,
                 const MaterialList<dim>                   &materials,
                 const std::vector<double>                 &alpha,
                 const std::vector<dealii::Tensor<1, dim>> &displacement)
  {
    const auto    &mesh = fit.mesh();
    ErrorIndicator indicator;
    indicator.squares.assign(mesh.n_cells(), 0.);
    std::vector<dealii::Tensor<4, dim>> stiffness;
    for (const auto &material : materials)
      stiffness.push_back(material->tangent(dealii::Tensor<2, dim>()));
    const bool one_material = materials.size() == 1;
    // Gradients at nodes, on each material of its own.
    std::map<std::pair<unsigned int, unsigned int>, dealii::Tensor<2, dim>>
               gradients;
    const auto gradient_at = [&](const unsigned int node,
                                 const unsigned int material) {
      const auto known = gradients.find({node, material});
      if (known != gradients.end())
        return known->second;
      const auto gradient =
        fit
          .fit(mesh.nodes[node],
               mesh.spacing[node],
               one_material ? DisplacementFit<dim>::any_material
                            : static_cast<int>(material),
               displacement,
               node)
          .gradient;
      return gradients[{node, material}] = gradient;
    };
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto &nodes = mesh.cells[c];
        if (std::any_of(nodes.begin(), nodes.end(), [&](const unsigned int n) {
              return alpha[n] > 0.;
            }))
          continue;
        const unsigned int            material = mesh.cell_material[c];
        const Mesh::CellGeometry<dim> geometry(mesh.corners(c));
        for (unsigned int q = 0; q < geometry.n_points; ++q)
          {
            dealii::Tensor<2, dim> element, smooth;
            for (unsigned int v = 0; v < nodes.size(); ++v)
              {
                element += dealii::outer_product(displacement[nodes[v]],
                                                 geometry.gradients[q][v]);
                smooth +=
                  geometry.shape_value(q, v) * gradient_at(nodes[v], material);
              }
            const auto energy = [&](const dealii::Tensor<2, dim> &gradient) {
              return geometry.jxw[q] *
                     dealii::scalar_product(
                       gradient,
                       dealii::double_contract<2, 0, 3, 1>(stiffness[material],
                                                           gradient));
            };
            indicator.squares[c] += energy(smooth - element);
            indicator.energy += energy(element);
          }
        if (!std::isfinite(indicator.squares[c]))
          indicator.squares[c] = 0.; // no fit there
      }
    return indicator;
  }

  std::vector<unsigned int>
  cells_with_most_error(const ErrorIndicator &indicator, const double fraction)
  {
    const auto                n = indicator.squares.size();
    std::vector<unsigned int> order(n);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(),
              order.end(),
              [&](const unsigned int a, const unsigned int b) {
                return indicator.squares[a] > indicator.squares[b];
              });
    const double total =
      std::accumulate(indicator.squares.begin(), indicator.squares.end(), 0.);
    double sum   = 0.;
    double least = 0.;
    for (std::size_t k = 0; k < n && sum < fraction * total; ++k)
      {
        least = indicator.squares[order[k]];
        sum += least;
      }
    std::vector<unsigned int> cells;
    for (const unsigned int c : order)
      if (least > 0. && indicator.squares[c] >= (1. - 1e-6) * least)
        cells.push_back(c);
    std::sort(cells.begin(), cells.end());
    return cells;
  }

  template ErrorIndicator
  estimate_error<2>(const DisplacementFit<2> &,
                    const MaterialList<2> &,
                    const std::vector<double> &,
                    const std::vector<dealii::Tensor<1, 2>> &);
  template ErrorIndicator
  estimate_error<3>(const DisplacementFit<3> &,
                    const MaterialList<3> &,
                    const std::vector<double> &,
                    const std::vector<dealii::Tensor<1, 3>> &);
} // namespace Perimorph::Fracture
