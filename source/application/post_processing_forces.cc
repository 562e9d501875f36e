#include <perimorph/application/post_processing.h>
#include <perimorph/fem/face_geometry.h>

#include <algorithm>

namespace Perimorph::Application
{
  template <int dim>
  double
  PostProcessing<dim>::reaction_at(const unsigned int dof,
                                   const State<dim>  &state) const
  {
    if (!supports.hold(dof))
      return 0.;
    return state.internal_force[dof / dim][dof % dim] -
           state.external_force[dof / dim][dof % dim];
  }

  template <int dim>
  dealii::Tensor<1, dim>
  PostProcessing<dim>::reaction(const std::string &boundary,
                                const State<dim>  &state) const
  {
    dealii::Tensor<1, dim> sum;
    for (const auto &[dof, entry] : supports.entries())
      if (entry.boundary == boundary)
        sum[dof % dim] += reaction_at(dof, state);
    for (const unsigned int node : supports.coupled_nodes())
      if (supports.boundary_motion_at(node) == boundary)
        for (int d = 0; d < dim; ++d)
          {
            const auto entry = supports.entries().find(dim * node + d);
            if (entry == supports.entries().end())
              sum[d] += reaction_at(dim * node + d, state);
          }
    return sum;
  }

  template <int dim>
  dealii::Tensor<1, dim>
  PostProcessing<dim>::vector_area(const std::string &boundary) const
  {
    const auto            &nodal = mesh.nodal();
    dealii::Tensor<1, dim> area;
    for (const unsigned int f : mesh.boundary(boundary, "nominal stress"))
      for (const auto &normal :
           Fem::FaceGeometry<dim>(nodal, nodal.boundary_faces[f]).normal_jxw)
        area += normal;
    return area;
  }

  template <int dim>
  double
  PostProcessing<dim>::nominal_stress(const State<dim> &state) const
  {
    if (parameters.nominal_stress.value)
      return *parameters.nominal_stress.value;
    const auto &name = parameters.nominal_stress.reaction_of;
    if (name.empty())
      return 1.;
    // Mean normal stress: tension positive.
    const auto area = vector_area(name);
    return reaction(name, state) * area / area.norm_square();
  }

  template <int dim>
  dealii::Tensor<1, dim>
  PostProcessing<dim>::outer_force(const unsigned int node,
                                   const State<dim>  &state) const
  {
    auto force = state.external_force[node];
    for (int d = 0; d < dim; ++d)
      force[d] += reaction_at(dim * node + d, state);
    return force;
  }

  template <int dim>
  double
  PostProcessing<dim>::imbalance(const State<dim> &state,
                                 double           &largest_force) const
  {
    const auto            &nodal = mesh.nodal();
    dealii::Tensor<1, dim> force;
    dealii::Tensor<2, dim> moment;
    double                 magnitude = 0., lever = 0.;
    for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
      {
        const auto             outer = outer_force(n, state);
        dealii::Tensor<1, dim> arm   = nodal.nodes[n] - nodal.nodes[0];
        // Moments balance where the forces act.
        if (parameters.finite_strain())
          arm += state.displacement[n];
        force += outer;
        moment += outer_product(arm, outer) - outer_product(outer, arm);
        magnitude += outer.norm();
        lever += arm.norm() * outer.norm();
      }
    if (magnitude == 0.)
      return 0.;
    // In a state without load what is left over is round-off of earlier ones.
    largest_force = std::max(largest_force, magnitude);
    return std::max(force.norm(), moment.norm() * magnitude / lever) /
           largest_force;
  }

  template class PostProcessing<2>;
  template class PostProcessing<3>;
} // namespace Perimorph::Application
