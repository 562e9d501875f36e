#include <perimorph/base/point_cloud.h>
#include <perimorph/fracture/mirrored_nodes.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Perimorph::Fracture
{
  namespace
  {
    /// A product of mirrors, X -> rotation X + shift; a displacement follows
    /// the rotation.
    template <int dim>
    struct Image
    {
      dealii::Tensor<2, dim>    rotation;
      dealii::Tensor<1, dim>    shift;
      std::vector<unsigned int> planes; ///< that were used

      dealii::Point<dim>
      of(const dealii::Point<dim> &point) const
      {
        return dealii::Point<dim>(rotation * dealii::Tensor<1, dim>(point) +
                                  shift);
      }
    };

    /// All different products of up to four mirrors (four close the group of
    /// two planes at 45 degrees, three that of orthogonal planes), the
    /// identity first.
    template <int dim>
    std::vector<Image<dim>>
    products_of_mirrors(const std::vector<MirrorPlane<dim>> &planes,
                        const double                         length)
    {
      std::vector<Image<dim>> images(1);
      for (int d = 0; d < dim; ++d)
        images[0].rotation[d][d] = 1.;

      const auto known = [&](const Image<dim> &candidate) {
        return std::any_of(
          images.begin(),
          images.end(),
          [&](const auto &image) {
            return (image.rotation - candidate.rotation).norm() < 1e-9 &&
                   (image.shift - candidate.shift).norm() < 1e-9 * length;
          });
      };

      std::size_t begin = 0;
      for (unsigned int n_factors = 1; n_factors <= 4; ++n_factors)
        {
          const std::size_t end = images.size();
          for (std::size_t i = begin; i < end; ++i)
            for (unsigned int p = 0; p < planes.size(); ++p)
              {
                const auto &normal   = planes[p].normal;
                const auto  previous = images[i];
                const auto reflect = [&](const dealii::Tensor<1, dim> &vector) {
                  return vector - 2. * (normal * vector) * normal;
                };

                Image<dim> image;
                image.planes = previous.planes;
                image.planes.push_back(p);
                for (int b = 0; b < dim; ++b)
                  {
                    dealii::Tensor<1, dim> column;
                    for (int a = 0; a < dim; ++a)
                      column[a] = previous.rotation[a][b];
                    column = reflect(column);
                    for (int a = 0; a < dim; ++a)
                      image.rotation[a][b] = column[a];
                  }
                const dealii::Tensor<1, dim> anchor(planes[p].point);
                image.shift = anchor + reflect(previous.shift - anchor);
                if (!known(image))
                  images.push_back(image);
              }
          begin = end;
        }
      return images;
    }
  } // namespace


  template <int dim>
  MirroredNodes<dim>::MirroredNodes(const Mesh::NodalMesh<dim>          &mesh,
                                    const std::vector<MirrorPlane<dim>> &planes,
                                    const double reach_factor)
  {
    auto points = mesh.nodes;
    nodes.resize(mesh.n_nodes());
    std::iota(nodes.begin(), nodes.end(), 0u);
    images_of_points.assign(mesh.n_nodes(), 0);
    add_copies(mesh, planes, reach_factor, points);
    tree = std::make_unique<Base::PointCloud<dim>>(std::move(points));
  }


  template <int dim>
  MirroredNodes<dim>::~MirroredNodes() = default;

  template <int dim>
  const Base::PointCloud<dim> &
  MirroredNodes<dim>::search() const
  {
    return *tree;
  }

  template <int dim>
  void
  MirroredNodes<dim>::add_copies(const Mesh::NodalMesh<dim>          &mesh,
                                 const std::vector<MirrorPlane<dim>> &planes,
                                 const double                     reach_factor,
                                 std::vector<dealii::Point<dim>> &points)
  {
    const double length =
      mesh.n_nodes() == 0
        ? 1.
        : *std::max_element(mesh.spacing.begin(), mesh.spacing.end());
    const auto images = products_of_mirrors(planes, length);
    for (const auto &i : images)
      rotations.push_back(i.rotation);
    if (planes.empty())
      return;

    // Held nodes of each plane that mirrors in part, to ask for the
    // nearest.
    std::vector<std::unique_ptr<Base::PointCloud<dim>>> held(planes.size());
    for (unsigned int p = 0; p < planes.size(); ++p)
      if (!planes[p].nodes.empty())
        {
          std::vector<dealii::Point<dim>> held_points;
          for (const unsigned int n : planes[p].nodes)
            held_points.push_back(mesh.nodes[n]);
          held[p] =
            std::make_unique<Base::PointCloud<dim>>(std::move(held_points));
        }

    std::vector<double>             distances(planes.size());
    std::vector<dealii::Point<dim>> copies;
    for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
      {
        const auto  &original = mesh.nodes[n];
        const double spacing  = mesh.spacing[n];
        const double reach    = reach_factor * spacing;

        bool near_a_plane = false;
        for (unsigned int p = 0; p < planes.size(); ++p)
          {
            distances[p] = (original - planes[p].point) * planes[p].normal;
            bool near    = std::abs(distances[p]) < reach;
            if (near && held[p])
              near = held[p]
                       ->nearest(original - distances[p] * planes[p].normal)
                       .second < 1.01 * spacing;
            if (!near)
              distances[p] = 2. * reach; // out of the game
            near_a_plane = near_a_plane || near;
          }
        if (!near_a_plane)
          continue;

        copies = {original};
        for (unsigned int i = 1; i < images.size(); ++i)
          {
            const auto copy = images[i].of(original);
            const bool far_off =
              std::any_of(images[i].planes.begin(),
                          images[i].planes.end(),
                          [&](const unsigned int p) {
                            return std::abs(distances[p]) >= reach;
                          });
            // A point of the body is nearer to a node than to its copies,
            // so the copy matters only within twice the radius of the
            // original.
            if (far_off || copy.distance(original) > 2. * reach ||
                std::any_of(copies.begin(), copies.end(), [&](const auto &c) {
                  return c.distance(copy) < 1e-6 * spacing;
                }))
              continue;
            copies.push_back(copy);
            points.push_back(copy);
            nodes.push_back(n);
            images_of_points.push_back(i);
          }
      }
  }

  template class MirroredNodes<2>;
  template class MirroredNodes<3>;
} // namespace Perimorph::Fracture
