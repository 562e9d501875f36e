#include <perimorph/application/crack_setup.h>
#include <perimorph/application/simulation.h>
#include <perimorph/base/exceptions.h>
#include <perimorph/base/log.h>
#include <perimorph/fracture/error_indicator.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    /// More halvings of a cell, or more cells, are a mistake.
    constexpr double most_halvings = 16.;
    constexpr double most_cells    = 1e7;

    /// @throws Base::InputError
    template <int dim>
    void
    check_spacing(const Mesh::NodalMesh<dim>      &mesh,
                  const std::vector<unsigned int> &large_cells,
                  const double                     spacing)
    {
      double longest = 0.;
      for (const unsigned int c : large_cells)
        for (const unsigned int n : mesh.cells[c])
          longest = std::max(longest, mesh.spacing[n]);
      const bool too_many =
        mesh.n_cells() + ((1u << dim) - 1.) * large_cells.size() > most_cells;
      if (!too_many && longest < std::pow(2., most_halvings) * spacing)
        return;
      std::ostringstream found, allowed;
      found << spacing << ", which takes more than ";
      if (too_many)
        found << most_cells << " cells";
      else
        found << most_halvings << " halvings of cells of " << longest;
      allowed << "at least the spacing of the file / 2^" << most_halvings
              << ", at most " << most_cells << " cells";
      throw Base::InputError(
        Base::InputMessage{"parameter 'Mesh / Refinement / target spacing'",
                           found.str(),
                           allowed.str(),
                           "Is it in the unit of the mesh?"});
    }

    /// Where peridynamics is, with the cracks, whose ends may still move.
    template <int dim>
    Mesh::RegionParameters
    region_with_cracks(const SimulationParameters<dim> &parameters)
    {
      auto                                region = parameters.region;
      std::vector<Bonds::CrackFacet<dim>> facets;
      for (const auto &line : parameters.pre_cracks)
        for (const auto &facet :
             facets_of_line<dim>(line, points_of_line<dim>(line), 0))
          facets.push_back(facet);
      for (const auto &feature : crack_features(Bonds::CrackSet<dim>(facets)))
        region.features.push_back(feature);
      return region;
    }

    template <int dim>
    std::string
    spacings(const Mesh::NodalMesh<dim> &mesh)
    {
      const auto [smallest, largest] =
        std::minmax_element(mesh.spacing.begin(), mesh.spacing.end());
      std::ostringstream text;
      text << "spacing " << *smallest << " to " << *largest;
      return text.str();
    }
  } // namespace

  template <int dim>
  void
  Simulation<dim>::make_mesh(const Mesh::GmshMesh<dim> &gmsh_mesh)
  {
    mesh =
      std::make_unique<Mesh::DistributedMesh<dim>>(gmsh_mesh, communicator);
  }

  template <int dim>
  void
  Simulation<dim>::refine_mesh(const Mesh::GmshMesh<dim> &coarse)
  {
    const auto &rule = parameters.refinement;
    refinement =
      std::make_unique<Mesh::LocalRefinement<dim>>(coarse, rule.find_curves);
    if (rule.spacing == 0.)
      return;
    const auto region = region_with_cracks(parameters);
    for (auto large = Mesh::too_large_cells(*mesh, region, rule);
         !large.empty();
         large = Mesh::too_large_cells(*mesh, region, rule))
      {
        check_spacing(mesh->nodal(), large, rule.spacing);
        refinement->refine(large);
        make_mesh(refinement->mesh());
      }
  }

  template <int dim>
  bool
  Simulation<dim>::refine_beside_families()
  {
    if (!refinement)
      return false;
    const auto cells = Mesh::cells_that_disturb_families(mesh->nodal(), region);
    if (cells.empty())
      return false;
    refinement->refine(cells);
    make_mesh(refinement->mesh());
    return true;
  }

  template <int dim>
  void
  Simulation<dim>::refine_by_error()
  {
    const auto &rule = parameters.refinement;
    for (unsigned int cycle = 1; cycle <= rule.error_cycles; ++cycle)
      {
        Method     method = set_up(parameters.region.mode);
        const auto record =
          method.equilibrium->solve(parameters.times().front(),
                                    method.displacement,
                                    [](const auto &) {});
        if (!record.converged)
          throw Base::SolveError("error cycle " + std::to_string(cycle) +
                                 " did not converge: " + record.reason);
        const auto state     = gather(method);
        const auto indicator = [&]() {
          const auto timer = timing.scope("recovery");
          return Fracture::estimate_error(post_processing->displacement_fit(),
                                          materials.laws,
                                          method.region.alpha,
                                          state.displacement);
        }();
        const double error = indicator.relative_error();
        log << "Error cycle " << cycle << ": " << mesh->nodal().n_nodes()
            << " nodes, estimated error of the elements " << 100. * error
            << " %" << std::endl;
        const auto cells =
          Fracture::cells_with_most_error(indicator, rule.error_fraction);
        if (error <= rule.error_tolerance || cells.empty())
          break;
        method           = Method();
        const auto timer = timing.scope("setup");
        refinement->refine(cells);
        make_mesh(refinement->mesh());
        prepare_body();
      }
    if (rule.error_cycles > 0)
      report_refinement();
  }

  template <int dim>
  void
  Simulation<dim>::warn_of_hanging_families(const Mesh::RegionMap &region)
  {
    if (mesh->nodal().hanging.empty() || hanging_is_announced ||
        Mesh::cells_that_disturb_families(mesh->nodal(), region).empty())
      return;
    hanging_is_announced = true;
    log.warning("the peridynamic region has grown to where the mesh gets "
                "coarser by halves: results from here on are less accurate. "
                "Name the way of the crack in 'Mesh / Refinement / around'.");
  }

  template <int dim>
  void
  Simulation<dim>::report_refinement()
  {
    if (!refinement)
      return;
    const auto &nodal = mesh->nodal();
    log << "  refined to " << nodal.n_nodes() << " nodes ("
        << nodal.hanging.size() << " hang), " << nodal.n_cells() << " cells, "
        << spacings(nodal) << "\n";
    for (const auto &curve : refinement->curves())
      log << "  boundary " << curve << "\n";
    log << std::flush;
    for (const auto &boundary : refinement->unknown_curves())
      log.warning("boundary '" + boundary +
                  "' is no curve that refinement knows: its new nodes lie on "
                  "the straight sides of the coarse mesh");
    if (nodal.n_nodes() == n_coarse_nodes &&
        parameters.refinement.error_cycles == 0)
      log.warning("'Mesh / Refinement / target spacing' changes nothing: the "
                  "mesh is as fine already");
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Perimorph::Application
