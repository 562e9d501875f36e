#include <perimorph/fracture/error_norms.h>
#include <perimorph/mesh/cell_geometry.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Perimorph::Fracture
{
  namespace
  {
    double
    ratio(const double error, const double reference)
    {
      if (error == 0.)
        return 0.;
      return reference > 0. ? error / reference
                            : std::numeric_limits<double>::infinity();
    }

    /// Twice the stored energy per volume at small strain.
    template <int dim>
    double
    twice_energy(const dealii::Tensor<4, dim> &tangent,
                 const dealii::Tensor<2, dim> &gradient)
    {
      return dealii::scalar_product(
        gradient,
        dealii::double_contract<2, 0, 3, 1>(tangent, gradient));
    }

    template <int dim>
    dealii::Tensor<2, dim>
    gradient_at(const Mesh::NodalMesh<dim>                &mesh,
                const unsigned int                         cell,
                const Mesh::CellGeometry<dim>             &geometry,
                const unsigned int                         q,
                const std::vector<dealii::Tensor<1, dim>> &field)
    {
      dealii::Tensor<2, dim> gradient;
      for (unsigned int v = 0; v < geometry.n_nodes; ++v)
        gradient += dealii::outer_product(field[mesh.cells[cell][v]],
                                          geometry.gradients[q][v]);
      return gradient;
    }
  } // namespace

  template <int dim>
  ErrorNorms
  error_norms(const Mesh::NodalMesh<dim>                &mesh,
              const MaterialList<dim>                   &materials,
              const std::vector<dealii::Tensor<1, dim>> &error,
              const std::vector<dealii::Tensor<1, dim>> &reference,
              const MPI_Comm                             communicator)
  {
    const dealii::Tensor<2, dim>        rest;
    std::vector<dealii::Tensor<4, dim>> tangents;
    for (const auto &material : materials)
      tangents.push_back(material->tangent(rest));

    std::vector<double> sums(4, 0.); // squares, energies: error, reference
    std::vector<double> maxima(2, 0.);
    for (unsigned int n = mesh.owned_begin; n < mesh.owned_end; ++n)
      {
        sums[0] += mesh.volume[n] * error[n].norm_square();
        sums[1] += mesh.volume[n] * reference[n].norm_square();
        maxima[0] = std::max(maxima[0], error[n].norm());
        maxima[1] = std::max(maxima[1], reference[n].norm());
      }
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (mesh.owns_cell(c))
        {
          const Mesh::CellGeometry<dim> geometry(mesh.corners(c));
          const auto &tangent = tangents[mesh.cell_material[c]];
          for (unsigned int q = 0; q < geometry.n_points; ++q)
            {
              sums[2] +=
                geometry.jxw[q] *
                twice_energy(tangent, gradient_at(mesh, c, geometry, q, error));
              sums[3] +=
                geometry.jxw[q] *
                twice_energy(tangent,
                             gradient_at(mesh, c, geometry, q, reference));
            }
        }
    std::vector<double> all_sums(4);
    std::vector<double> all_maxima(2);
    dealii::Utilities::MPI::sum(sums, communicator, all_sums);
    dealii::Utilities::MPI::max(maxima, communicator, all_maxima);

    // Round-off can make the energy of a rigid motion negative.
    ErrorNorms norms;
    norms.l2      = ratio(std::sqrt(all_sums[0]), std::sqrt(all_sums[1]));
    norms.energy  = ratio(std::sqrt(std::max(0., all_sums[2])),
                         std::sqrt(std::max(0., all_sums[3])));
    norms.maximum = ratio(all_maxima[0], all_maxima[1]);
    return norms;
  }

  template ErrorNorms
  error_norms<2>(const Mesh::NodalMesh<2> &,
                 const MaterialList<2> &,
                 const std::vector<dealii::Tensor<1, 2>> &,
                 const std::vector<dealii::Tensor<1, 2>> &,
                 MPI_Comm);
  template ErrorNorms
  error_norms<3>(const Mesh::NodalMesh<3> &,
                 const MaterialList<3> &,
                 const std::vector<dealii::Tensor<1, 3>> &,
                 const std::vector<dealii::Tensor<1, 3>> &,
                 MPI_Comm);
} // namespace Perimorph::Fracture
