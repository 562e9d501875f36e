#pragma once

#include <perimorph/fracture/force_points.h>
#include <perimorph/materials/material_factory.h>

#include "near_tip_bodies.h"

namespace Perimorph::Testing
{
  enum class Source
  {
    cells,                ///< full law everywhere, one-sided fits at the crack
    families,             ///< alpha = 1
    families_and_elements ///< families beside the crack, blended
  };

  /// A plate of 2 by 2 whose nodes move by the exact field times a factor.
  struct Plate
  {
    NearTipCase                       field;
    double                            h;
    Mesh::NodalMesh<2>                mesh;
    Fracture::MaterialList<2>         materials;
    std::vector<dealii::Tensor<1, 2>> displacement;
    Bonds::CrackSet<2>                cracks;
    /// DeformedBody::acceleration, of density 1
    std::vector<dealii::Tensor<1, 2>> acceleration = {};

    /// @param law  isotropic; empty: that of the field
    Plate(const unsigned int n_cells,
          const double       angle,
          const double       distortion,
          const double       factor = 1.,
          const std::string &law    = "",
          const NearTipCase &body   = {})
      : field(body)
      , h(2. / n_cells)
    {
      field.angle = angle;
      // between the nodes along the crack or somewhere in a cell
      field.tip = dealii::Point<2>(0.25 * h, (angle == 0. ? -0.5 : -0.1) * h);
      mesh      = structured_mesh<2>({{n_cells, n_cells}},
                                dealii::Point<2>(-1., -1.),
                                dealii::Point<2>(1., 1.),
                                distortion);
      materials.push_back(
        law.empty() ? field.law()
                    : Materials::make_material<2>(law,
                                                  1.,
                                                  near_tip_poissons_ratio,
                                                  field.state));
      for (const auto &x : mesh.nodes)
        displacement.push_back(factor * field.at(x).displacement);
      cracks = field.crack();
    }

    Fracture::StressPointSet<2>
    points(const Source source) const
    {
      const Fracture::DeformedBody<2> body =
        {mesh, materials, displacement, {}, acceleration, {1.}};
      const auto region = Fracture::nodes_within<2>(mesh, {field.tip}, 0.9);
      const auto fit    = Fracture::visible_fit(mesh, cracks);
      Fracture::StressPointSet<2> set;
      add_force_points(body, cracks, *fit, region, set);
      if (source == Source::cells)
        {
          add_cell_points(body, cracks, *fit, region, set);
          return set;
        }
      std::vector<double> alpha(mesh.n_nodes(), 1.);
      if (source == Source::families_and_elements)
        for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
          {
            const double distance =
              std::abs((mesh.nodes[n] - field.tip) * field.frame().axes[1]);
            alpha[n] = std::clamp(2.5 - distance / (4. * h), 0., 1.);
          }
      const auto families = cut_families(mesh, alpha, 2., cracks, *field.law());
      add_element_points(body, alpha, region, set);
      add_family_points(body, cracks, families, region, set);
      return set;
    }

    Fracture::FractureQuantities
    quantities(Fracture::StressPointSet<2> set,
               const Fracture::Annulus    &annulus,
               const MPI_Comm              communicator = MPI_COMM_SELF) const
    {
      return fracture_quantities(set,
                                 mesh,
                                 field.frame(),
                                 annulus,
                                 field.constants(),
                                 communicator);
    }
  };
} // namespace Perimorph::Testing
