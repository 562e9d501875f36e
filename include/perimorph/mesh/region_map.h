#pragma once

#include <perimorph/mesh/distributed_mesh.h>
#include <perimorph/parameters/features.h>

#include <string>
#include <vector>

namespace Perimorph::Mesh
{
  /// Who carries the strain energy.
  enum class Mode
  {
    coupled,
    finite_elements,
    peridynamics
  };

  /// Shape of alpha across the blending band, from 1 at the core to 0.
  enum class BlendingFunction
  {
    linear,
    cubic,
    quintic,
    splice ///< 1 in the core, 0 elsewhere: no band
  };

  const std::vector<std::string> &
  mode_names();
  const std::vector<std::string> &
  blending_function_names();

  /// Value at s in [0, 1] (0: edge of the core, 1: end of the band).
  double
  blending_weight(BlendingFunction function, double s);

  /// Where peridynamics is and how it fades into finite elements.
  struct RegionParameters
  {
    Mode                             mode = Mode::coupled;
    std::vector<Parameters::Feature> features;
    Parameters::Length               core_size      = {2., true, false};
    Parameters::Length               blending_width = {0., false, true};
    BlendingFunction blending_function              = BlendingFunction::cubic;
    double           horizon_ratio                  = 2.;
    double           horizon_length                 = 0.; ///< 0: use the ratio
    bool             may_fill_body = false; ///< a core that has grown may
  };

  /// A size of the region where nodes have this spacing and horizon;
  /// automatic: the horizon, at least two spacings.
  double
  length_of(const Parameters::Length &size, double spacing, double horizon);

  /// Blending weight and horizon of every node, identical on all ranks.
  struct RegionMap
  {
    std::vector<double> alpha;   ///< 1 peridynamics, 0 finite elements
    std::vector<double> horizon; ///< [length]

    unsigned int n_core     = 0; ///< nodes with alpha = 1
    unsigned int n_blending = 0; ///< nodes with 0 < alpha < 1
    unsigned int n_elements = 0; ///< nodes with alpha = 0

    /// Sets weights and counts.
    void
    set_alpha(const std::vector<double> &weights);
  };

  /// Places the peridynamic region. A size in horizons is measured with the
  /// horizon at the nearest place of the feature.
  /// @throws Base::InputError  names not in the mesh, an empty region, one that
  ///         swallows the body, a horizon smaller than the spacing
  template <int dim>
  RegionMap
  make_region_map(const DistributedMesh<dim> &mesh,
                  const RegionParameters     &parameters);
} // namespace Perimorph::Mesh
