#include <perimorph/fem/rigid_motion.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Perimorph::Fem
{
  namespace
  {
    template <int dim>
    constexpr unsigned int n_modes = dim *(dim + 1) / 2;

    /// Unit translations, then rotations in the planes (a, b) scaled by 1 /
    /// size.
    template <int dim>
    std::vector<FreeMotion<dim>>
    all_motions(const unsigned int        piece,
                const dealii::Point<dim> &center,
                const double              size)
    {
      std::vector<FreeMotion<dim>> motions;
      for (int d = 0; d < dim; ++d)
        {
          FreeMotion<dim> motion;
          motion.piece          = piece;
          motion.center         = center;
          motion.translation[d] = 1.;
          motions.push_back(motion);
        }
      for (const auto &generator : rotation_generators<dim>())
        {
          FreeMotion<dim> motion;
          motion.piece    = piece;
          motion.center   = center;
          motion.rotation = generator / size;
          motions.push_back(motion);
        }
      return motions;
    }

    template <int dim>
    FreeMotion<dim>
    combine(const std::vector<FreeMotion<dim>> &motions,
            const Eigen::VectorXd              &coefficients)
    {
      FreeMotion<dim> sum;
      sum.piece  = motions[0].piece;
      sum.center = motions[0].center;
      for (unsigned int k = 0; k < motions.size(); ++k)
        {
          sum.translation += coefficients[k] * motions[k].translation;
          sum.rotation += coefficients[k] * motions[k].rotation;
        }
      return sum;
    }
  } // namespace

  template <int dim>
  const std::vector<dealii::Tensor<2, dim>> &
  rotation_generators()
  {
    static const auto list = []() {
      std::vector<dealii::Tensor<2, dim>> generators;
      for (int a = 0; a < dim; ++a)
        for (int b = a + 1; b < dim; ++b)
          {
            dealii::Tensor<2, dim> generator;
            generator[a][b] = -1.;
            generator[b][a] = 1.;
            generators.push_back(generator);
          }
      return generators;
    }();
    return list;
  }

  template <int dim>
  std::string
  FreeMotion<dim>::description() const
  {
    std::ostringstream text;
    if (translation.norm() > 1e-6)
      {
        text << "translation along (";
        for (int d = 0; d < dim; ++d)
          text << (d > 0 ? ", " : "")
               << std::round(1e3 * translation[d] / translation.norm()) / 1e3 +
                    0.;
        text << ")";
      }
    if (rotation.norm() > 1e-6 * (translation.norm() + rotation.norm()))
      text << (text.str().empty() ? "rotation" : " with rotation");
    return text.str();
  }

  template <int dim>
  std::vector<FreeMotion<dim>>
  free_motions(const Mesh::NodalMesh<dim>      &nodal,
               const std::vector<unsigned int> &pieces,
               const Supports<dim>             &supports)
  {
    const unsigned int n_pieces =
      1 + *std::max_element(pieces.begin(), pieces.end());
    std::vector<dealii::Point<dim>> center(n_pieces);
    std::vector<unsigned int>       count(n_pieces, 0);
    std::vector<double>             size(n_pieces, 0.);
    for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
      {
        center[pieces[n]] += nodal.nodes[n];
        ++count[pieces[n]];
      }
    for (unsigned int p = 0; p < n_pieces; ++p)
      center[p] /= count[p];
    for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
      size[pieces[n]] =
        std::max(size[pieces[n]], nodal.nodes[n].distance(center[pieces[n]]));

    // Gram matrix of the motions at the supported degrees of freedom: its null
    // space is what the supports leave free.
    std::vector<std::vector<FreeMotion<dim>>> motions;
    std::vector<Eigen::MatrixXd>              gram;
    for (unsigned int p = 0; p < n_pieces; ++p)
      {
        // A piece of one node has no size.
        motions.push_back(
          all_motions(p, center[p], size[p] > 0. ? size[p] : 1.));
        gram.push_back(Eigen::MatrixXd::Zero(n_modes<dim>, n_modes<dim>));
      }
    const auto hold = [&](const unsigned int piece, const auto &amount_of) {
      Eigen::VectorXd row(n_modes<dim>);
      for (unsigned int k = 0; k < n_modes<dim>; ++k)
        row[k] = amount_of(motions[piece][k]);
      gram[piece] += row * row.transpose();
    };
    for (const auto &entry : supports.entries())
      {
        const unsigned int node = entry.first / dim;
        hold(pieces[node], [&](const FreeMotion<dim> &motion) {
          return motion.at(nodal.nodes[node])[entry.first % dim];
        });
      }
    for (const auto &mean : supports.mean_constraints())
      {
        const unsigned int piece = pieces[mean.factors.begin()->first / dim];
        hold(piece, [&](const FreeMotion<dim> &motion) {
          double sum = 0.;
          for (const auto &[dof, factor] : mean.factors)
            sum += factor * motion.at(nodal.nodes[dof / dim])[dof % dim];
          return sum;
        });
      }
    for (const auto &plate : supports.rigid_plates())
      {
        const unsigned int piece = pieces[plate.nodes[0]];
        for (int d = 0; d < dim; ++d)
          if (plate.translation[d])
            hold(piece, [&](const FreeMotion<dim> &motion) {
              return motion.at(plate.center)[d];
            });
        if (plate.rotation)
          for (int a = 0; a < dim; ++a)
            for (int b = a + 1; b < dim; ++b)
              hold(piece, [&](const FreeMotion<dim> &motion) {
                return size[piece] * motion.rotation[a][b];
              });
      }
    std::vector<FreeMotion<dim>> result;
    for (unsigned int p = 0; p < n_pieces; ++p)
      {
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram[p]);
        for (unsigned int k = 0; k < n_modes<dim>; ++k)
          if (solver.eigenvalues()[k] < 1e-10)
            result.push_back(combine(motions[p], solver.eigenvectors().col(k)));
      }
    return result;
  }

  template <int dim>
  std::vector<unsigned int>
  pins_against(const Mesh::DistributedMesh<dim>   &mesh,
               const std::vector<FreeMotion<dim>> &motions)
  {
    const auto               &nodal  = mesh.nodal();
    const auto               &pieces = mesh.pieces();
    auto                      free   = motions;
    std::vector<unsigned int> pins;
    while (!free.empty())
      {
        // Pin where one free motion moves most. Values within round-off count
        // as equal and are decided by position, so that the choice does not
        // depend on the node numbering.
        const auto   motion = free.back();
        double       best   = 0.;
        unsigned int pin    = 0;
        for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
          if (pieces[n] == motion.piece && !nodal.hangs(n))
            for (int d = 0; d < dim; ++d)
              {
                const double value  = std::abs(motion.at(nodal.nodes[n])[d]);
                bool         better = value > best * (1. + 1e-8);
                if (!better && value > best * (1. - 1e-8))
                  {
                    const auto &x = nodal.nodes[n];
                    const auto &y = nodal.nodes[pin / dim];
                    int         k = 0;
                    while (k < dim &&
                           std::abs(x[k] - y[k]) < 1e-8 * nodal.spacing[n])
                      ++k;
                    better = k < dim && x[k] < y[k];
                  }
                if (better)
                  {
                    best = value;
                    pin  = dim * n + d;
                  }
              }
        pins.push_back(pin);
        // Remaining motions are combined so that they vanish at the pin.
        free.pop_back();
        const auto  &x       = nodal.nodes[pin / dim];
        const double divisor = motion.at(x)[pin % dim];
        for (auto &other : free)
          if (other.piece == motion.piece)
            {
              const double factor = other.at(x)[pin % dim] / divisor;
              other.translation -= factor * motion.translation;
              other.rotation -= factor * motion.rotation;
            }
      }
    return pins;
  }

  template const std::vector<dealii::Tensor<2, 2>> &
  rotation_generators<2>();
  template const std::vector<dealii::Tensor<2, 3>> &
  rotation_generators<3>();
  template struct FreeMotion<2>;
  template struct FreeMotion<3>;
  template std::vector<FreeMotion<2>>
  free_motions<2>(const Mesh::NodalMesh<2> &,
                  const std::vector<unsigned int> &,
                  const Supports<2> &);
  template std::vector<FreeMotion<3>>
  free_motions<3>(const Mesh::NodalMesh<3> &,
                  const std::vector<unsigned int> &,
                  const Supports<3> &);
  template std::vector<unsigned int>
  pins_against<2>(const Mesh::DistributedMesh<2> &,
                  const std::vector<FreeMotion<2>> &);
  template std::vector<unsigned int>
  pins_against<3>(const Mesh::DistributedMesh<3> &,
                  const std::vector<FreeMotion<3>> &);
} // namespace Perimorph::Fem
