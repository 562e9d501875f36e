#include <perimorph/base/exceptions.h>
#include <perimorph/fem/nodal_values.h>
#include <perimorph/fem/rigid_motion.h>
#include <perimorph/solvers/constraints.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace Perimorph::Solvers
{
  namespace
  {
    /// Finite rotation exp(spin) of an antisymmetric tensor (Rodrigues).
    template <int dim>
    dealii::Tensor<2, dim>
    finite_rotation(const dealii::Tensor<2, dim> &spin)
    {
      const double angle = spin.norm() / std::sqrt(2.);
      const double first = angle > 0. ? std::sin(angle) / angle : 1.;
      const double half  = angle > 0. ? std::sin(angle / 2.) : 0.;
      const double second =
        angle > 0. ? 2. * half * half / (angle * angle) : 0.5;
      dealii::Tensor<2, dim> rotation = first * spin + second * (spin * spin);
      for (int d = 0; d < dim; ++d)
        rotation[d][d] += 1.;
      return rotation;
    }

    /// Rows of a matrix that tell its columns apart best.
    std::vector<unsigned int>
    independent_rows(const Eigen::MatrixXd &matrix)
    {
      const Eigen::MatrixXd scaled =
        matrix * matrix.colwise().norm().cwiseInverse().asDiagonal();
      const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled.transpose());
      std::vector<unsigned int>                         result;
      for (int k = 0; k < matrix.cols(); ++k)
        result.push_back(qr.colsPermutation().indices()[k]);
      return result;
    }

    std::vector<unsigned int>
    all_below(const unsigned int n)
    {
      std::vector<unsigned int> list(n);
      std::iota(list.begin(), list.end(), 0u);
      return list;
    }
  } // namespace

  template <int dim>
  Constraints<dim>::Constraints(const Fem::NodePartition<dim> &partition,
                                const Fem::Supports<dim>      &supports,
                                const Mesh::HangingPoints     &hanging,
                                const bool                     small_rotations)
    : partition(partition)
    , supports(supports)
    , hanging(hanging)
    , small_rotations(small_rotations)
  {
    std::set<unsigned int> supported;
    const auto            &owned = partition.owned_dofs();
    for (const auto &entry : supports.entries())
      if (owned.is_element(entry.first))
        {
          owned_prescribed.push_back(entry.first);
          supported.insert(entry.first);
        }
    for (const auto &mean : supports.mean_constraints())
      for (const auto &entry : mean.factors)
        if (owned.is_element(entry.first))
          supported.insert(entry.first);
    for (const auto &plate : supports.rigid_plates())
      for (const unsigned int node : plate.nodes)
        for (int d = 0; d < dim; ++d)
          if (owned.is_element(dim * node + d))
            supported.insert(dim * node + d);
    for (const unsigned int dof : supported)
      owned_supported.push_back(local(dof));
    reduce_means();
    for (const auto &plate : supports.rigid_plates())
      add_plate(plate);
    make_lines();
  }

  template <int dim>
  void
  Constraints<dim>::reduce_means()
  {
    const auto &means = supports.mean_constraints();
    // Gauss-Jordan elimination: each row keeps one dependent unknown that no
    // other row has.
    std::vector<std::map<unsigned int, double>> free(means.size());
    Eigen::MatrixXd                             of_means =
      Eigen::MatrixXd::Identity(means.size(), means.size());
    for (unsigned int r = 0; r < means.size(); ++r)
      for (const auto &entry : means[r].factors)
        if (supports.entries().count(entry.first) == 0)
          free[r].insert(entry);
    std::vector<unsigned int> pivots(means.size());
    for (unsigned int r = 0; r < means.size(); ++r)
      {
        double original = 0.;
        for (const auto &entry : means[r].factors)
          original = std::max(original, std::abs(entry.second));
        auto best = free[r].end();
        for (auto entry = free[r].begin(); entry != free[r].end(); ++entry)
          if (best == free[r].end() ||
              std::abs(entry->second) > std::abs(best->second) * (1. + 1e-8))
            best = entry;
        if (best == free[r].end() || std::abs(best->second) < 1e-10 * original)
          throw Base::InputError(Base::InputMessage{
            "parameter 'Boundary conditions / mean displacement'",
            "conditions that follow from each other or contradict",
            "independent conditions on the mean motion of boundaries",
            ""});
        const unsigned int pivot   = best->first;
        const double       divisor = best->second;
        pivots[r]                  = pivot;
        for (auto &entry : free[r])
          entry.second /= divisor;
        of_means.row(r) /= divisor;
        for (unsigned int s = 0; s < means.size(); ++s)
          if (s != r && free[s].count(pivot) > 0)
            {
              const double factor = free[s].at(pivot);
              for (const auto &entry : free[r])
                free[s][entry.first] -= factor * entry.second;
              free[s].erase(pivot);
              of_means.row(s) -= factor * of_means.row(r);
            }
      }
    for (unsigned int r = 0; r < means.size(); ++r)
      {
        Row row;
        row.dependent = pivots[r];
        for (const auto &[dof, factor] : free[r])
          if (dof != pivots[r] && factor != 0.)
            row.entries.emplace_back(dof, -factor);
        for (unsigned int s = 0; s < means.size(); ++s)
          row.of_means.push_back(of_means(r, s));
        rows.push_back(row);
      }
  }

  template <int dim>
  dealii::Tensor<1, dim>
  Constraints<dim>::arm(const Plate &plate, const unsigned int node) const
  {
    return plate.rotation *
           (partition.position(partition.local(node)) - plate.support->center);
  }

  template <int dim>
  Eigen::MatrixXd
  Constraints<dim>::velocities(const Plate                     &plate,
                               const std::vector<unsigned int> &dofs,
                               const std::vector<unsigned int> &motions) const
  {
    Eigen::MatrixXd result(dofs.size(), motions.size());
    for (unsigned int k = 0; k < dofs.size(); ++k)
      for (unsigned int m = 0; m < motions.size(); ++m)
        {
          const unsigned int component = dofs[k] % dim;
          const unsigned int motion    = motions[m];
          result(k, m)                 = motion < dim
                                           ? (motion == component ? 1. : 0.)
                                           : (Fem::rotation_generators<dim>()[motion - dim] *
                              arm(plate, dofs[k] / dim))[component];
        }
    return result;
  }

  template <int dim>
  void
  Constraints<dim>::add_plate(const Fem::RigidPlate<dim> &support)
  {
    Plate plate;
    plate.support  = &support;
    plate.rotation = dealii::unit_symmetric_tensor<dim>();
    for (unsigned int motion = 0; motion < n_motions; ++motion)
      if (motion < dim ? !support.translation[motion] : !support.rotation)
        plate.free_motions.push_back(motion);
    std::vector<unsigned int> dofs;
    for (const unsigned int node : support.nodes)
      for (int d = 0; d < dim; ++d)
        dofs.push_back(dim * node + d);
    if (!plate.free_motions.empty())
      for (const unsigned int k :
           independent_rows(velocities(plate, dofs, plate.free_motions)))
        plate.masters.push_back(dofs[k]);
    for (const unsigned int k :
         independent_rows(velocities(plate, dofs, all_below(n_motions))))
      plate.markers.push_back(dofs[k]);
    linearize(plate);
    plates.push_back(plate);
  }

  template <int dim>
  void
  Constraints<dim>::linearize(Plate &plate) const
  {
    plate.free_of_masters =
      velocities(plate, plate.masters, plate.free_motions).inverse();
    plate.motions_of_markers =
      velocities(plate, plate.markers, all_below(n_motions)).inverse();
  }

  template <int dim>
  void
  Constraints<dim>::make_lines()
  {
    const auto relevant = partition.relevant_dofs();
    affine.reinit(relevant);
    for (const auto &entry : supports.entries())
      if (relevant.is_element(entry.first))
        affine.add_line(entry.first);
    for (const Row &row : rows)
      {
        affine.add_line(row.dependent);
        for (const auto &entry : row.entries)
          affine.add_entry(row.dependent, entry.first, entry.second);
      }
    for (const Plate &plate : plates)
      for (const unsigned int node : plate.support->nodes)
        for (int d = 0; d < dim; ++d)
          {
            const unsigned int dof = dim * node + d;
            if (std::find(plate.masters.begin(), plate.masters.end(), dof) !=
                plate.masters.end())
              continue;
            affine.add_line(dof);
            if (plate.masters.empty())
              continue;
            const Eigen::MatrixXd entries =
              velocities(plate, {dof}, plate.free_motions) *
              plate.free_of_masters;
            for (unsigned int m = 0; m < plate.masters.size(); ++m)
              affine.add_entry(dof, plate.masters[m], entries(0, m));
          }
    for (const auto &[node, parents] : hanging)
      for (int d = 0; d < dim; ++d)
        if (relevant.is_element(dim * node + d))
          {
            affine.add_line(dim * node + d);
            for (const auto &[parent, weight] : parents)
              affine.add_entry(dim * node + d, dim * parent + d, weight);
          }
    affine.close();
  }

  template <int dim>
  double
  Constraints<dim>::support_norm(const Vector &force) const
  {
    double square = 0.;
    for (const unsigned int entry : owned_supported)
      square += std::pow(force.local_element(entry), 2);
    return std::sqrt(
      dealii::Utilities::MPI::sum(square, partition.communicator()));
  }

  template <int dim>
  void
  Constraints<dim>::condense_hanging(Vector &force) const
  {
    Fem::condense_hanging(hanging, partition, force);
  }

  template <int dim>
  void
  Constraints<dim>::set_hanging(Vector &displacement) const
  {
    if (hanging.empty())
      return;
    displacement.update_ghost_values();
    const auto &owned = partition.owned_dofs();
    for (const auto &[node, parents] : hanging)
      for (int d = 0; d < dim; ++d)
        if (owned.is_element(dim * node + d))
          {
            double value = 0.;
            for (const auto &[parent, weight] : parents)
              value +=
                weight * displacement.local_element(local(dim * parent + d));
            displacement.local_element(local(dim * node + d)) = value;
          }
    displacement.zero_out_ghost_values();
  }

  template <int dim>
  void
  Constraints<dim>::condense(Vector &force) const
  {
    force.zero_out_ghost_values();
    const auto &owned = partition.owned_dofs();
    for (const auto &line : affine.get_lines())
      if (owned.is_element(line.index))
        {
          const double value = force.local_element(local(line.index));
          force.local_element(local(line.index)) = 0.;
          for (const auto &entry : line.entries)
            force.local_element(local(entry.first)) += entry.second * value;
        }
    if (couple_unknowns() || !hanging.empty())
      force.compress(dealii::VectorOperation::add);
  }

  template <int dim>
  void
  Constraints<dim>::distribute(Vector &increment) const
  {
    if (couple_unknowns() || !hanging.empty())
      increment.update_ghost_values();
    const auto &owned = partition.owned_dofs();
    for (const auto &line : affine.get_lines())
      if (owned.is_element(line.index))
        {
          double value = 0.;
          for (const auto &entry : line.entries)
            value += entry.second * increment.local_element(local(entry.first));
          increment.local_element(local(line.index)) = value;
        }
    increment.zero_out_ghost_values();
  }

  template <int dim>
  bool
  Constraints<dim>::particular(const double  time,
                               const Vector &displacement,
                               Vector       &increment) const
  {
    increment.zero_out_ghost_values();
    increment = 0.;
    for (const unsigned int dof : owned_prescribed)
      increment.local_element(local(dof)) =
        supports.value(dof, time) - displacement.local_element(local(dof));

    const auto         &owned = partition.owned_dofs();
    const auto         &means = supports.mean_constraints();
    std::vector<double> missing(means.size(), 0.);
    for (unsigned int r = 0; r < means.size(); ++r)
      for (const auto &[dof, factor] : means[r].factors)
        if (owned.is_element(dof))
          missing[r] -= factor * (displacement.local_element(local(dof)) +
                                  increment.local_element(local(dof)));
    if (!means.empty())
      dealii::Utilities::MPI::sum(missing, partition.communicator(), missing);
    for (unsigned int r = 0; r < means.size(); ++r)
      missing[r] += means[r].value->value(means[r].center, time);
    for (const Row &row : rows)
      if (owned.is_element(row.dependent))
        for (unsigned int s = 0; s < means.size(); ++s)
          increment.local_element(local(row.dependent)) +=
            row.of_means[s] * missing[s];

    for (const Plate &plate : plates)
      {
        const auto     &support = *plate.support;
        Eigen::VectorXd change  = Eigen::VectorXd::Zero(n_motions);
        Eigen::VectorXd current = Eigen::VectorXd::Zero(n_motions);
        if (small_rotations)
          current = motions(plate, displacement);
        else
          for (int d = 0; d <= dim; ++d)
            current[d] = d < dim ? plate.translation[d] : plate.angle;
        for (int d = 0; d < dim; ++d)
          if (support.translation[d])
            change[d] =
              support.translation[d]->value(support.center, time) - current[d];
        // In 3D only a rotation of zero is allowed: nothing to do.
        if (dim == 2 && support.rotation)
          change[dim] =
            support.rotation->value(support.center, time) - current[dim];
        for (const unsigned int node : support.nodes)
          for (int d = 0; d < dim; ++d)
            if (owned.is_element(dim * node + d))
              increment.local_element(local(dim * node + d)) =
                (velocities(plate, {dim * node + d}, all_below(n_motions)) *
                 change)(0);
      }
    set_hanging(increment);
    const double size = increment.linfty_norm();
    // Below round-off of the displacement the supports are where they belong.
    return size > 1e-13 * (size + displacement.linfty_norm());
  }

  template <int dim>
  Eigen::VectorXd
  Constraints<dim>::motions(const Plate &plate, const Vector &vector) const
  {
    std::vector<double> values(n_motions, 0.);
    for (unsigned int k = 0; k < n_motions; ++k)
      if (partition.owned_dofs().is_element(plate.markers[k]))
        values[k] = vector.local_element(local(plate.markers[k]));
    dealii::Utilities::MPI::sum(values, partition.communicator(), values);
    return plate.motions_of_markers *
           Eigen::Map<Eigen::VectorXd>(values.data(), n_motions);
  }

  template <int dim>
  void
  Constraints<dim>::move(const double  step,
                         const Vector &increment,
                         Vector       &displacement)
  {
    displacement.zero_out_ghost_values();
    displacement.add(step, increment);
    if (are_linear())
      return;
    const auto &owned = partition.owned_dofs();
    for (Plate &plate : plates)
      {
        const Eigen::VectorXd  change = step * motions(plate, increment);
        dealii::Tensor<2, dim> spin;
        for (unsigned int k = dim; k < n_motions; ++k)
          spin += change[k] * Fem::rotation_generators<dim>()[k - dim];
        for (int d = 0; d < dim; ++d)
          plate.translation[d] += change[d];
        plate.rotation = finite_rotation(spin) * plate.rotation;
        if (dim == 2)
          plate.angle += change[dim];
        for (const unsigned int node : plate.support->nodes)
          {
            const auto rigid = plate.translation + arm(plate, node) -
                               (partition.position(partition.local(node)) -
                                plate.support->center);
            for (int d = 0; d < dim; ++d)
              if (owned.is_element(dim * node + d))
                displacement.local_element(local(dim * node + d)) = rigid[d];
          }
        linearize(plate);
      }
    set_hanging(displacement);
    make_lines();
  }

  template <int dim>
  typename Constraints<dim>::State
  Constraints<dim>::state() const
  {
    State state;
    for (const Plate &plate : plates)
      {
        state.translation.push_back(plate.translation);
        state.rotation.push_back(plate.rotation);
        state.angle.push_back(plate.angle);
      }
    return state;
  }

  template <int dim>
  void
  Constraints<dim>::restore(const State &state)
  {
    if (are_linear())
      return;
    for (unsigned int p = 0; p < plates.size(); ++p)
      {
        plates[p].translation = state.translation[p];
        plates[p].rotation    = state.rotation[p];
        plates[p].angle       = state.angle[p];
        linearize(plates[p]);
      }
    make_lines();
  }

  template <int dim>
  template <typename AnyMatrix>
  void
  Constraints<dim>::add_geometric_stiffness(const Vector &force,
                                            AnyMatrix    &matrix) const
  {
    if (are_linear())
      return;
    const auto        &owned = partition.owned_dofs();
    const auto        &spins = Fem::rotation_generators<dim>();
    const unsigned int n     = spins.size();
    for (const Plate &plate : plates)
      {
        if (plate.support->rotation)
          continue;
        std::vector<double> stiffness(n * n, 0.);
        for (const unsigned int node : plate.support->nodes)
          {
            if (!owned.is_element(dim * node))
              continue;
            dealii::Tensor<1, dim> f;
            for (int d = 0; d < dim; ++d)
              f[d] = force.local_element(local(dim * node + d));
            const auto a = arm(plate, node);
            for (unsigned int j = 0; j < n; ++j)
              for (unsigned int k = 0; k < n; ++k)
                stiffness[n * j + k] -=
                  0.5 * (f * ((spins[j] * spins[k] + spins[k] * spins[j]) * a));
          }
        dealii::Utilities::MPI::sum(stiffness,
                                    partition.communicator(),
                                    stiffness);
        // Rotations are the last of the free motions.
        const unsigned int first = plate.free_motions.size() - n;
        for (unsigned int r = 0; r < plate.masters.size(); ++r)
          if (owned.is_element(plate.masters[r]))
            for (unsigned int c = 0; c < plate.masters.size(); ++c)
              {
                double sum = 0.;
                for (unsigned int j = 0; j < n; ++j)
                  for (unsigned int k = 0; k < n; ++k)
                    sum += plate.free_of_masters(first + j, r) *
                           stiffness[n * j + k] *
                           plate.free_of_masters(first + k, c);
                matrix.add(plate.masters[r], plate.masters[c], sum);
              }
      }
    matrix.compress(dealii::VectorOperation::add);
  }

  template class Constraints<2>;
  template class Constraints<3>;

#define PERIMORPH_INSTANTIATE(dim, AnyMatrix)                             \
  template void Constraints<dim>::add_geometric_stiffness(const Vector &, \
                                                          AnyMatrix &) const;

  PERIMORPH_INSTANTIATE(2, Matrix)
  PERIMORPH_INSTANTIATE(3, Matrix)
  PERIMORPH_INSTANTIATE(2, dealii::SparseMatrix<double>)
  PERIMORPH_INSTANTIATE(3, dealii::SparseMatrix<double>)
#undef PERIMORPH_INSTANTIATE
} // namespace Perimorph::Solvers
