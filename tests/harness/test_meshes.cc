#include "test_meshes.h"

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace Perimorph
{
  namespace Testing
  {
    namespace
    {
      /// Linear index of a node or cell of a box with n[d] of them along axis
      /// d.
      template <int dim>
      unsigned int
      linear_index(const std::array<unsigned int, dim> &index,
                   const std::array<unsigned int, dim> &n)
      {
        unsigned int result = 0;
        for (int d = dim - 1; d >= 0; --d)
          result = result * n[d] + index[d];
        return result;
      }

      /// Steps to the next index, x fastest; false after the last one.
      template <int dim>
      bool
      advance(std::array<unsigned int, dim>       &index,
              const std::array<unsigned int, dim> &n)
      {
        for (int d = 0; d < dim; ++d)
          {
            if (++index[d] < n[d])
              return true;
            index[d] = 0;
          }
        return false;
      }

      /// Everything that does not depend on where the nodes are: cells,
      /// boundary faces with ids 2 d + side, one rank. Node positions along
      /// axis d wrap around if periodic[d].
      template <int dim>
      void
      connect(const std::array<unsigned int, dim> &n_cells,
              const std::array<bool, dim>         &periodic,
              Mesh::NodalMesh<dim>                &mesh)
      {
        std::array<unsigned int, dim> n_nodes = n_cells;
        for (int d = 0; d < dim; ++d)
          n_nodes[d] += periodic[d] ? 0 : 1;

        std::array<unsigned int, dim> index{};
        do
          {
            const unsigned int                  cell = mesh.cells.size();
            typename Mesh::NodalMesh<dim>::Cell nodes;
            for (unsigned int v = 0; v < nodes.size(); ++v)
              {
                auto node = index;
                for (int d = 0; d < dim; ++d)
                  node[d] = (node[d] + ((v >> d) & 1u)) % n_nodes[d];
                nodes[v] = linear_index<dim>(node, n_nodes);
              }
            mesh.cells.push_back(nodes);

            for (unsigned int face = 0; face < 2 * dim; ++face)
              {
                const unsigned int axis = face / 2;
                if (periodic[axis] ||
                    index[axis] != (face % 2 == 0 ? 0 : n_cells[axis] - 1))
                  continue;
                Mesh::BoundaryFace<dim> boundary_face;
                boundary_face.cell     = cell;
                boundary_face.face     = face;
                boundary_face.boundary = face;
                for (unsigned int v = 0; v < boundary_face.nodes.size(); ++v)
                  boundary_face.nodes[v] =
                    nodes[dealii::GeometryInfo<dim>::face_to_cell_vertices(face,
                                                                           v)];
                mesh.boundary_faces.push_back(boundary_face);
              }
          }
        while (advance<dim>(index, n_cells));

        mesh.cell_material.assign(mesh.n_cells(), 0);
        mesh.cell_owner.assign(mesh.n_cells(), 0);
        mesh.rank        = 0;
        mesh.owned_begin = 0;
        mesh.owned_end   = mesh.n_nodes();
        mesh.compute_derived();
      }

      /// n + 1 coordinates in [0, 1], last over first step = grading.
      std::vector<double>
      graded_coordinates(const unsigned int n, const double grading)
      {
        const double ratio = n > 1 ? std::pow(grading, 1. / (n - 1.)) : 1.;

        std::vector<double> x    = {0.};
        double              step = 1.;
        for (unsigned int k = 0; k < n; ++k, step *= ratio)
          x.push_back(x.back() + step);
        for (double &value : x)
          value /= x.back();
        x.back() = 1.;
        return x;
      }
    } // namespace

    template <int dim>
    Mesh::NodalMesh<dim>
    structured_mesh(const std::array<unsigned int, dim> &n_cells,
                    const dealii::Point<dim>            &lower,
                    const dealii::Point<dim>            &upper,
                    const double                         distortion,
                    const double                         grading)
    {
      std::array<unsigned int, dim>        n_nodes;
      std::array<std::vector<double>, dim> coordinates;
      for (int d = 0; d < dim; ++d)
        {
          n_nodes[d]     = n_cells[d] + 1;
          coordinates[d] = graded_coordinates(n_cells[d], grading);
          for (double &x : coordinates[d])
            x = lower[d] + x * (upper[d] - lower[d]);
        }

      Mesh::NodalMesh<dim>          mesh;
      std::mt19937                  engine(20240501);
      std::array<unsigned int, dim> index{};
      do
        {
          dealii::Point<dim>     node;
          dealii::Tensor<1, dim> shift;
          bool                   interior = true;
          for (int d = 0; d < dim; ++d)
            {
              const auto        &x = coordinates[d];
              const unsigned int k = index[d];
              node[d]              = x[k];
              // Raw engine output: the same numbers with every standard
              // library.
              const double random = 2. * (engine() / 4294967295.) - 1.;
              if (k == 0 || k == n_cells[d])
                interior = false;
              else
                shift[d] = distortion * random *
                           std::min(x[k] - x[k - 1], x[k + 1] - x[k]);
            }
          mesh.nodes.push_back(interior ? node + shift : node);
        }
      while (advance<dim>(index, n_nodes));

      connect<dim>(n_cells, {}, mesh);
      return mesh;
    }

    template <int dim>
    Mesh::NodalMesh<dim>
    unit_mesh(const unsigned int n_cells,
              const double       distortion,
              const double       grading)
    {
      std::array<unsigned int, dim> n;
      n.fill(n_cells);
      dealii::Point<dim> upper;
      for (int d = 0; d < dim; ++d)
        upper[d] = 1.;
      return structured_mesh<dim>(n,
                                  dealii::Point<dim>(),
                                  upper,
                                  distortion,
                                  grading);
    }

    template <int dim>
    Mesh::NodalMesh<dim>
    annulus_mesh(const unsigned int n_around,
                 const unsigned int n_radial,
                 const double       inner_radius,
                 const double       outer_radius,
                 const unsigned int n_height,
                 const double       height)
    {
      std::array<unsigned int, dim> n_cells{{n_radial, n_around}};
      std::array<unsigned int, dim> n_nodes{{n_radial + 1, n_around}};
      std::array<bool, dim>         periodic{{false, true}};
      if (dim == 3)
        {
          n_cells[dim - 1] = n_height;
          n_nodes[dim - 1] = n_height + 1;
        }

      Mesh::NodalMesh<dim>          mesh;
      std::array<unsigned int, dim> index{};
      do
        {
          const double radius =
            inner_radius + (outer_radius - inner_radius) * index[0] / n_radial;
          const double angle = 2. * std::acos(-1.) * index[1] / n_around;

          dealii::Point<dim> node;
          node[0] = radius * std::cos(angle);
          node[1] = radius * std::sin(angle);
          if (dim == 3)
            node[dim - 1] = height * index[dim - 1] / n_height;
          mesh.nodes.push_back(node);
        }
      while (advance<dim>(index, n_nodes));

      connect<dim>(n_cells, periodic, mesh);
      for (auto &face : mesh.boundary_faces)
        if (face.face >= 4)
          face.boundary = face.face - 2;
      return mesh;
    }

    template Mesh::NodalMesh<2>
    structured_mesh<2>(const std::array<unsigned int, 2> &,
                       const dealii::Point<2> &,
                       const dealii::Point<2> &,
                       double,
                       double);
    template Mesh::NodalMesh<3>
    structured_mesh<3>(const std::array<unsigned int, 3> &,
                       const dealii::Point<3> &,
                       const dealii::Point<3> &,
                       double,
                       double);
    template Mesh::NodalMesh<2>
    unit_mesh<2>(unsigned int, double, double);
    template Mesh::NodalMesh<3>
    unit_mesh<3>(unsigned int, double, double);
    template Mesh::NodalMesh<2>
    annulus_mesh<2>(unsigned int,
                    unsigned int,
                    double,
                    double,
                    unsigned int,
                    double);
    template Mesh::NodalMesh<3>
    annulus_mesh<3>(unsigned int,
                    unsigned int,
                    double,
                    double,
                    unsigned int,
                    double);
  } // namespace Testing
} // namespace Perimorph
