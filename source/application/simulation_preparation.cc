#include <perimorph/application/crack_groups.h>
#include <perimorph/application/crack_setup.h>
#include <perimorph/application/meshed_cracks.h>
#include <perimorph/application/simulation.h>
#include <perimorph/application/stability_advice.h>
#include <perimorph/base/log.h>
#include <perimorph/base/name_help.h>
#include <perimorph/damage/saw_tooth.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Perimorph::Application
{
  template <int dim>
  void
  Simulation<dim>::prepare()
  {
    const auto timer = timing.scope("setup");
    read_mesh();
    prepare_body();
    report_refinement();
    warn_of_varying_axes();
    warn_if_nothing_happens();
    if (parameters.growth.bonds)
      {
        const auto &growth = parameters.growth;
        broken             = Bonds::BrokenBonds(growth.n_teeth);
        breaking_rule =
          parameters.coupling.model == Coupling::Model::bond_based ||
              growth.n_teeth > 1
            ? Damage::make_saw_tooth_rule<dim>(growth.limits,
                                               growth.n_teeth,
                                               parameters.state)
            : Damage::make_breaking_rule<dim>(growth.criterion,
                                              growth.limits,
                                              parameters.state,
                                              parameters.coupling.scheme ==
                                                  Coupling::Scheme::consistent
                                                ? Damage::FamilyShape::cells
                                                : Damage::FamilyShape::ball);
        for (const auto &facet : cracks.facets())
          for (const auto &corner : facet.corners)
            failure_planes.add_tip(corner);
        warn_of_bond_criteria();
      }
    // Anisotropic laws have no Poisson's ratio: 0.
    std::pair<double, double> ratios(parameters.material.poissons_ratio,
                                     parameters.material.poissons_ratio);
    for (const auto &entry : parameters.volume_materials)
      {
        const double ratio = entry.second.poissons_ratio;
        ratios.first       = std::min(ratios.first, ratio);
        ratios.second      = std::max(ratios.second, ratio);
      }
    if (parameters.state == Materials::PlaneState::plane_stress)
      ratios.second = 0.;
    for (const auto &text : stability_advice(mesh->nodal(),
                                             region,
                                             parameters.coupling,
                                             ratios,
                                             parameters.finite_strain()))
      log.warning(text);
    check_time_step();
    for (const unsigned int node : loads->loaded_points())
      {
        std::ostringstream text;
        text << "the force on the single node (" << mesh->nodal().nodes[node]
             << ") of a " << dim << "D solid: the displacement under it grows "
             << "without limit as the mesh is refined. Spread it over a "
                "boundary ('traction').";
        log.warning(text.str());
      }
  }

  template <int dim>
  void
  Simulation<dim>::prepare_body()
  {
    Base::InputErrorCollector errors;
    const auto                times = parameters.times();
    errors.collect([&]() { place_region(); });
    errors.collect([&]() { assign_materials(); });
    errors.collect([&]() {
      supports =
        std::make_unique<Fem::Supports<dim>>(*mesh,
                                             parameters.boundary_conditions,
                                             times);
    });
    errors.collect([&]() {
      loads = std::make_unique<Fem::Loads<dim>>(*mesh,
                                                parameters.boundary_conditions,
                                                times);
    });
    if (supports && !materials.laws.empty())
      errors.collect([&]() {
        post_processing = std::make_unique<PostProcessing<dim>>(parameters,
                                                                *mesh,
                                                                materials,
                                                                *supports,
                                                                cracks);
      });
    if (supports && loads)
      {
        errors.collect([&]() { check_crack_mouths(); });
        if (!parameters.time_integration.has_inertia())
          errors.collect([&]() { hold_rigid_motion(); });
        errors.collect([&]() { check_motion(); });
      }
    errors.throw_if_any();
  }

  template <int dim>
  void
  Simulation<dim>::place_region()
  {
    const auto timer = timing.scope("regions");
    do
      {
        parameters.region.features = region_features;
        place_cracks();
        region = make_region_map(*mesh, parameters.region);
      }
    while (refine_beside_families());
    check_cracks();
    is_protected =
      protected_nodes(*mesh, region, parameters.growth.protected_features);
  }

  template <int dim>
  void
  Simulation<dim>::place_cracks()
  {
    if (parameters.pre_cracks.empty())
      return;
    if (parameters.region.mode == Mesh::Mode::finite_elements)
      {
        cracks = make_meshed_cracks(mesh->nodal(), parameters.pre_cracks);
        return;
      }
    cracks = make_cracks(mesh->nodal(),
                         parameters.pre_cracks,
                         parameters.region.horizon_ratio);
    for (const auto &feature : crack_features(cracks))
      parameters.region.features.push_back(feature);
  }

  template <int dim>
  void
  Simulation<dim>::check_cracks() const
  {
    if (parameters.region.mode == Mesh::Mode::finite_elements)
      return;
    std::vector<std::string> names;
    for (const auto &line : parameters.pre_cracks)
      names.push_back(line.name);
    check_cracks_in_core(mesh->nodal(), region, cracks, names);
  }

  template <int dim>
  void
  Simulation<dim>::check_crack_mouths()
  {
    if (parameters.region.mode == Mesh::Mode::finite_elements)
      return;
    const auto &nodal = mesh->nodal();
    for (const auto &mouth : find_mouths(nodal, cracks))
      {
        const auto &facet  = cracks.facets()[mouth.facet];
        const auto &nodes  = nodal.boundary_faces[mouth.face].nodes;
        const auto &name   = parameters.pre_cracks[facet.crack].name;
        const auto  normal = facet.normal();
        for (int d = 0; d < dim; ++d)
          {
            // A plane of symmetry holds what lies along the crack only.
            if (std::abs(normal[d]) < 0.1)
              continue;
            const bool held =
              std::all_of(nodes.begin(), nodes.end(), [&](const unsigned n) {
                return supports->entries().count(dim * n + d) > 0 ||
                       !supports->boundary_motion_at(n).empty();
              });
            if (!held)
              continue;
            const auto entry    = supports->entries().find(dim * nodes[0] + d);
            const auto boundary = entry == supports->entries().end()
                                    ? supports->boundary_motion_at(nodes[0])
                                    : entry->second.boundary;
            throw Base::InputError(Base::InputMessage{
              "parameter 'Cracks / pre-cracks'",
              "'" + name + "' ends on boundary '" + boundary +
                "', which is held across the crack",
              "ends in the body, or on surfaces that can open",
              "Let the crack end before it."});
          }
        for (const auto &load : loads->surface_loads())
          {
            const auto &faces = mesh->boundary(load.boundary, "loads");
            if (std::find(faces.begin(), faces.end(), mouth.face) !=
                faces.end())
              log.warning("crack '" + name +
                          "' opens a face of the loaded boundary '" +
                          load.boundary +
                          "': what acts on this face goes to its nodes as if "
                          "there were no crack");
          }
      }
  }

  template <int dim>
  void
  Simulation<dim>::read_mesh()
  {
    const auto  timer = timing.scope("mesh");
    const auto &file  = parameters.mesh_file;
    const auto  gmsh_mesh =
      Mesh::read_gmsh<dim>(file, parameters.geometry_parameters, communicator);
    parameters.pre_cracks = read_crack_groups(gmsh_mesh, parameters.pre_cracks);
    region_features       = parameters.region.features;
    make_mesh(gmsh_mesh);
    const auto &nodal = mesh->nodal();
    n_coarse_nodes    = nodal.n_nodes();
    log << "Mesh: " << file << "\n  " << nodal.n_nodes() << " nodes, "
        << nodal.n_cells() << " cells; boundaries: ";
    log << Base::join_names(mesh->boundary_names()) << std::endl;
    if (parameters.refinement.spacing > 0. ||
        parameters.refinement.error_cycles > 0)
      refine_mesh(gmsh_mesh);
  }

  template <int dim>
  void
  Simulation<dim>::assign_materials()
  {
    materials = make_body_materials<dim>(*mesh,
                                         parameters.material,
                                         parameters.volume_materials,
                                         parameters.state);
  }

  template <int dim>
  void
  Simulation<dim>::warn_of_varying_axes() const
  {
    const auto &nodal  = mesh->nodal();
    const auto  varies = [&](const unsigned int n) {
      if (region.alpha[n] == 0.)
        return false;
      const auto  cells = nodal.node_cells.row(n);
      const auto  first = nodal.cell_material[cells[0]];
      const auto &of    = materials.material_of_law;
      return std::any_of(cells.begin(), cells.end(), [&](const unsigned int c) {
        const auto law = nodal.cell_material[c];
        return law != first && of[law] == of[first];
      });
    };
    for (unsigned int n = 0; n < nodal.n_nodes(); ++n)
      if (varies(n))
        {
          log.warning("the material axes vary in the peridynamic region: "
                      "families end where the angle changes, so that forces "
                      "there reach no further than those of elements");
          break;
        }
  }

  template <int dim>
  void
  Simulation<dim>::hold_rigid_motion()
  {
    free_motions = Fem::free_motions(*mesh, *supports);
    if (free_motions.empty())
      return;
    std::string list;
    for (const auto &motion : free_motions)
      list += (list.empty() ? "" : ", ") + motion.description();
    if (!parameters.boundary_conditions.remove_rigid_motion)
      throw Base::InputError(
        Base::InputMessage{"section 'Boundary conditions'",
                           "no support against " + list,
                           "supports that prevent every rigid motion",
                           "Add symmetry or displacement conditions, or set "
                           "'remove rigid motion = true'."});
    if (!supports->act() && loads->empty())
      throw Base::InputError(Base::InputMessage{
        "section 'Boundary conditions'",
        "neither supports nor loads",
        "at least one displacement, traction, pressure, body "
        "force or point condition",
        ""});
    std::vector<unsigned int> needed;
    Fem::add_cell_nodes(mesh->nodal(), needed);
    check_load_balance(
      Fem::NodePartition<dim>(mesh->nodal(), needed, communicator));
    for (const unsigned int pin : Fem::pins_against(*mesh, free_motions))
      supports->pin(pin);
    log << "No support prevents " << list
        << (parameters.finite_strain()
              ? "; it is held at single points."
              : "; the mean of this motion is removed.")
        << std::endl;
  }

  template <int dim>
  void
  Simulation<dim>::warn_if_nothing_happens()
  {
    if (!loads->empty() || starts_in_motion())
      return;
    for (const double time : parameters.times())
      if (supports->move(time))
        return;
    log.warning("no load and no prescribed displacement other than zero: the "
                "body will stay at rest");
  }


  template <int dim>
  void
  Simulation<dim>::check_load_balance(
    const Fem::NodePartition<dim> &partition) const
  {
    Fem::Vector forces;
    partition.initialize(forces);
    for (const double time : parameters.times())
      {
        forces.zero_out_ghost_values();
        forces = 0.;
        loads->add_forces(time, partition, forces);
        forces.compress(dealii::VectorOperation::add);
        for (const auto &motion : free_motions)
          {
            double work = 0., magnitude = 0.;
            for (unsigned int n = 0; n < partition.n_owned(); ++n)
              if (mesh->pieces()[partition.global(n)] == motion.piece)
                {
                  const auto velocity = motion.at(partition.position(n));
                  for (int d = 0; d < dim; ++d)
                    {
                      const double term =
                        forces.local_element(dim * n + d) * velocity[d];
                      work += term;
                      magnitude += std::abs(term);
                    }
                }
            work      = dealii::Utilities::MPI::sum(work, communicator);
            magnitude = dealii::Utilities::MPI::sum(magnitude, communicator);
            if (std::abs(work) > 1e-8 * magnitude)
              throw Base::InputError(Base::InputMessage{
                "section 'Boundary conditions'",
                "loads that push the body in a direction that no support "
                "prevents: " +
                  motion.description(),
                "loads in balance, or supports that take them",
                "Add symmetry or displacement conditions."});
          }
      }
  }

  template <int dim>
  void
  Simulation<dim>::report_validation()
  {
    log
      << "Mode: "
      << Mesh::mode_names()[static_cast<int>(parameters.region.mode)] << ", "
      << Coupling::model_names()[static_cast<int>(parameters.coupling.model)]
      << ", coupling "
      << Coupling::scheme_names()[static_cast<int>(parameters.coupling.scheme)]
      << "\n  " << region.n_core << " nodes peridynamic, " << region.n_blending
      << " blended, " << region.n_elements << " finite elements only\n"
      << "The input is valid." << std::endl;
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Perimorph::Application
