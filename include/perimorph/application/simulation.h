#pragma once

#include <perimorph/application/motion_integrator.h>
#include <perimorph/application/post_processing.h>
#include <perimorph/application/simulation_states.h>
#include <perimorph/base/timing.h>
#include <perimorph/bonds/broken_bonds.h>
#include <perimorph/coupling/moving_bonds.h>
#include <perimorph/damage/breaking_rule.h>
#include <perimorph/fem/rigid_motion.h>
#include <perimorph/fracture/crack_tips.h>
#include <perimorph/mesh/local_refinement.h>
#include <perimorph/output/checkpoint.h>
#include <perimorph/output/csv_writer.h>
#include <perimorph/output/field_output.h>
#include <perimorph/output/results.h>

#include <map>
#include <memory>
#include <optional>
#include <set>

namespace Perimorph::Base
{
  class Log;
}

namespace Perimorph::Application
{
  /// A run from the parameters to the results. Reads like a table of contents;
  /// each chapter is a room of its own.
  template <int dim>
  class Simulation
  {
  public:
    /// @param origins  where entries were set, for messages found later
    Simulation(const SimulationParameters<dim> &parameters,
               Base::Log                       &log,
               MPI_Comm                         communicator);
    ~Simulation();

    /// Reads mesh and regions and checks everything that can be wrong.
    /// @throws Base::InputError
    void
    prepare();

    /// After prepare(): solves the first load step and halves the elements with
    /// the largest errors, as often as was asked for.
    /// @throws Base::InputError, Base::SolveError
    void
    refine_by_error();

    /// Reports what prepare() found, for --validate.
    void
    report_validation();

    /// After prepare(): run() goes on from this checkpoint of the output
    /// folder.
    /// @throws Base::InputError  another mesh, a table that is missing
    void
    resume(const Output::Checkpoint &earlier);

    /// Solves all load steps and writes the results.
    /// @param parameters_text  the parameters as used, saved with the results
    /// @param checkpoint  what all checkpoints of this run hold: parameters
    /// @throws Base::InputError, Base::SolveError
    void
    run(const std::string        &parameters_text,
        const Output::Checkpoint &checkpoint = {});

    /// Valid after run().
    const Output::Results &
    results() const
    {
      return *result;
    }

  private:
    using Method  = Application::Method<dim>;
    using Advance = Application::Advance<dim>;
    using Instant = Application::Instant<dim>;

    void
    read_mesh();
    /// What depends on the mesh.
    void
    prepare_body();
    void
    make_mesh(const Mesh::GmshMesh<dim> &gmsh_mesh);
    /// The mesh as it is wanted around the peridynamic region.
    void
    refine_mesh(const Mesh::GmshMesh<dim> &coarse);
    /// Keeps hanging nodes out of the families.
    /// @return  whether the mesh is another one
    bool
    refine_beside_families();
    /// Once: families of a region that has grown have hanging nodes.
    void
    warn_of_hanging_families(const Mesh::RegionMap &region);
    void
    report_refinement();
    void
    assign_materials();
    void
    warn_of_varying_axes() const;
    void
    place_region();
    /// Makes the cracks and places peridynamics around them.
    void
    place_cracks();
    void
    check_cracks() const;
    /// Cracks that open the surface: not where it is held across them.
    /// @throws Base::InputError
    void
    check_crack_mouths();
    void
    hold_rigid_motion();
    void
    warn_if_nothing_happens();
    /// Supports that methods without a matrix cannot hold, initial fields that
    /// are not finite.
    /// @throws Base::InputError
    void
    check_motion() const;
    bool
    starts_in_motion() const;
    /// An explicit time step that is given, against the stability limit.
    /// @throws Base::InputError
    void
    check_time_step();
    void
    check_load_balance(const Fem::NodePartition<dim> &partition) const;

    void
    open_output(const std::string &parameters_text);
    Method
    set_up(Mesh::Mode mode);
    Method
    make_method(const Mesh::RegionMap      &region,
                const Bonds::CrackSet<dim> &cracks,
                Coupling::SharedParts<dim>  shared = {});
    /// Nodes of parts that cracks cut off and supports leave free in a
    /// direction; none where loads would move them.
    std::vector<unsigned int>
    nodes_cut_off(const Bonds::CrackSet<dim> &cracks) const;
    /// What direct solvers share while cracks grow or bonds break.
    std::shared_ptr<Solvers::FactorMemory>
    make_factor_memory() const;
    void
    report_set_up(const Method &method);
    /// What the linear algebra and the output did not do.
    void
    report_skipped(const Method &method);
    using OnStep = std::function<void(const Step &)>;
    using OnNewton =
      std::function<void(const Step &, const Solvers::NewtonIteration &)>;

    /// Follows the loads to their end; on_step gets every step accepted. After
    /// a failure the state is the last one that converged, given to on_step
    /// too.
    /// @return  false if the arc length did not reach the end time
    /// @throws Base::SolveError
    bool
    follow_loads(Method         &method,
                 const OnStep   &on_step,
                 const OnNewton &on_newton);
    bool
    follow_arc(Method         &method,
               const OnStep   &on_step,
               const OnNewton &on_newton);
    using OnInstant = std::function<void(const Instant &)>;
    /// Follows the motion of a body to the end time; on_instant gets its states
    /// at the output intervals.
    /// @throws Base::InputError  a time step above the stability limit
    /// @throws Base::SolveError
    void
    follow_motion(Method &method, const OnInstant &on_instant);
    std::unique_ptr<MotionIntegrator<dim>>
    make_integrator(Method &method);
    /// Finds the stability limit first if it is not known.
    double
    longest_time_step(const MotionIntegrator<dim> &integrator,
                      const Method                &method);
    /// After a step: whether the longest time step is another now.
    bool
    limit_may_have_changed(const Method &method);
    /// The state of a method with its energies.
    Instant
    make_instant(Instant                      instant,
                 const MotionIntegrator<dim> &integrator,
                 Method                      &method);
    std::unique_ptr<Coupling::MovingBonds<dim>>
    make_moving_bonds(Method &method);
    enum class MotionChange
    {
      none,
      bonds, ///< the problem lost bonds
      region ///< the method is another one
    };
    /// Breaks the bonds that the state of a motion overloads; the core grows
    /// where they are not in it.
    MotionChange
    break_in_motion(Method                                      &method,
                    std::unique_ptr<Coupling::MovingBonds<dim>> &bonds);
    /// The same state with room for more bonds in the core.
    /// @throws Base::SolveError  it cannot grow there
    void
    grow_core_in_motion(Method                                         &method,
                        const std::vector<std::array<unsigned int, 2>> &bonds);
    Solvers::MotionState
    initial_motion(const Method &method) const;
    /// The run of a body that moves: tables, fields, checkpoints.
    void
    integrate_in_time(Method &method);
    State<dim>
    gather_motion(const Method               &method,
                  const Solvers::MotionState &motion,
                  const Fem::Vector          &internal_force,
                  const Fem::Vector          &external_force) const;
    /// Equilibrium at a time, by Newton's method or by relaxation.
    Solvers::NewtonRecord
    solve_equilibrium(double                                            time,
                      Method                                           &method,
                      const typename Solvers::Equilibrium<dim>::Report &report);
    /// Growth of cracks: advances at the loads of the state of a method while
    /// one releases its fracture energy; on_step gets the state after each.
    /// @return  false if the body is separated
    bool
    grow_cracks(Method &method, Step &step, const OnStep &on_step);
    /// Scales the loads of the end time so that each advance is just possible;
    /// on_step gets the states before and after each.
    /// Ends when the body is separated or no tip is left.
    /// @return  false if the largest number of advances was reached
    bool
    follow_growth_events(Method         &method,
                         const OnStep   &on_step,
                         const OnNewton &on_newton);
    /// What happens at the loads of a state before they rise further.
    /// @return  false if the body falls apart
    bool
    grow_at_fixed_loads(Method &method, Step &step, const OnStep &on_step);
    /// Before the first event: the solution at the end of the loads, which
    /// those of all events are multiples of.
    /// @throws Base::InputError  loads that are not in proportion to t
    void
    start_events(Method &method, Step &step, const OnNewton &on_newton);
    /// Brings both states of an advance to the load at which it releases its
    /// fracture energy.
    /// @throws Base::SolveError  none found (nonlinear problems)
    void
    find_load(Advance        &advance,
              Method         &method,
              Step           &step,
              const OnNewton &on_newton);
    /// Follows the loads of a nonlinear problem up or down, counting the work,
    /// as far as it converges.
    /// @throws Base::SolveError  not at all
    void
    rise_to(double time, Method &method, Step &step, const OnNewton &on_newton);
    /// The advance that needs least load; none when no tip is left. Replaces
    /// the method by one whose peridynamic core has room for it.
    std::optional<Advance>
    best_advance(Method &method);
    /// Lets a crack grow: the state of the method becomes the one behind the
    /// advance.
    void
    accept(Advance &advance, Method &method, Step &step);
    /// Equilibrium with a longer crack at the loads of a method; none if it
    /// cuts off what nothing holds.
    std::optional<Method>
    state_behind(const Bonds::CrackFacet<dim> &facet, const Method &method);
    /// Parts of the body between the cracks that are more than debris.
    unsigned int
    n_large_parts() const;
    /// Says why growth ended.
    void
    end_growth(const std::string &reason, const std::string &text);
    /// Counts of the cracks and bonds of a state.
    void
    report_cracks(const Method &method);
    /// Follows the loads to the load of each event at which bonds break;
    /// on_step gets the states before and after each.
    /// @return  false if the largest number of events was reached
    bool
    follow_bond_events(Method         &method,
                       const OnStep   &on_step,
                       const OnNewton &on_newton);
    /// The same events at the loads of the state of a method, while bonds break
    /// there; on_step gets the state after each.
    /// @return  false if the body falls apart
    bool
    break_overloaded_bonds(Method &method, Step &step, const OnStep &on_step);
    std::vector<BondLoad>
    bond_loads(const Method &method) const;
    /// The bonds with the lowest loads of all, within a tolerance, and those
    /// cut by planes that they open; none above the limit.
    /// @param loads  factors of bonds that wait for a crack beside them become
    ///               infinite
    std::vector<BondLoad>
    lowest_loads(const Method          &method,
                 double                 limit,
                 std::vector<BondLoad> &loads);
    /// The bonds that break first, all within a tolerance of the lowest load;
    /// none if that is above the limit or no bond extends. Replaces the method
    /// by one with a larger core if they are not in the core.
    /// @param limit  largest factor of the loads
    std::vector<BondLoad>
    next_to_break(Method &method, double limit);
    /// Takes a tooth of a bond in the present event and writes it down in
    /// broken_bonds.csv.
    /// @param time    or load factor
    /// @param energy  of the bond; none in motion
    void
    break_bond(const std::array<unsigned int, 2> &nodes,
               const Output::CsvCell             &step,
               double                             time,
               const std::optional<double>       &energy);
    /// Breaks bonds at fixed loads and accounts for the energies.
    /// @return  false if the body falls apart
    bool
    break_bonds(Method &method, std::vector<BondLoad> bonds, const Step &step);
    /// Makes cracks of the bonds that broke, once the longest of them reaches
    /// 'hand over length': they grow by segments while they have tips. Tips are
    /// put where the potential energy at fixed loads changes least; the change
    /// counts as switched_energy. on_step gets the state after.
    /// @return  whether it did
    bool
    hand_over(Method &method, Step &step, const OnStep &on_step);
    /// Whether cracks that were handed over grow by segments no longer, so that
    /// new ones start from bonds.
    bool
    hand_back();
    /// Newton iterations of the run so far.
    unsigned int
    n_solves() const;
    /// Names cracks that came from bonds.
    void
    name_nucleated_cracks();
    /// Large parts of the body and parts that loads act on.
    unsigned int
    n_parts(const Method &method, const State<dim> &loaded) const;
    void
    warn_of_bond_criteria() const;
    /// Replaces a method by one whose core has room for more features; the core
    /// does not shrink.
    /// @return  change of the potential energy, counted as switched_energy
    double
    grow_core(Method &method, const Mesh::RegionParameters &wider);
    /// The region of a method with what is wider of others; none if nothing is.
    std::optional<Mesh::RegionMap>
    grown_region(const Method                 &method,
                 const Mesh::RegionParameters &wider) const;
    /// A bond as a place of the region.
    Parameters::Feature
    feature_of(const std::array<unsigned int, 2> &bond) const;
    /// Solves a linear problem at another time.
    void
    scale_to(double          time,
             Method         &method,
             Step           &step,
             const OnNewton &on_newton);
    /// Solves at the time of a method with other cracks.
    Method
    solve_with(const Bonds::CrackSet<dim> &other_cracks,
               const Mesh::RegionMap      &region,
               const Method               &start);
    /// Solves at the time of another state, from its displacement.
    void
    continue_from(const Method &start, Method &method);
    double
    potential_energy(const Method &method) const;
    /// Adds the work done between the last state and this one.
    void
    count_work(const State<dim> &state);
    void
    write_advance(const Advance &advance, const Step &step);
    /// The run itself: follows the loads, writes tables and fields.
    bool
    solve_load_steps(Method &method);
    void
    warn_of_point_supports(const State<dim> &state, double largest_force);
    void
    remove_mean_rigid_motion(Method &method) const;
    State<dim>
    gather(const Method &method) const;
    void
    write_fields(const Method     &method,
                 const State<dim> &state,
                 unsigned int      step,
                 double            time);
    void
    evaluate(const Method &method, const State<dim> &state);
    std::vector<NamedQuantity>
    quantities(const Method &method, const State<dim> &state);
    /// Adds a row to quantities.csv.
    void
    write_quantities(unsigned int      step,
                     const Method     &method,
                     const State<dim> &state);
    void
    compare_with_finite_elements(const State<dim> &state);
    void
    finish(Output::Status status);

    // Checkpoints.
    /// Keeps the run behind a step that was accepted.
    void
    write_checkpoint(const Method &method, const State<dim> &state);
    /// Brings a method, fresh from set_up(), to the state of the checkpoint.
    void
    restore(Method &method);
    /// Drops from tables and series what came behind the checkpoint.
    void
    continue_output();
    /// Files in the output folder that the checkpoint builds upon.
    std::set<std::string>
    files_to_keep() const;
    /// A new table, or the one of the run that is continued.
    Output::CsvWriter &
    open_table(const std::string              &name,
               const std::vector<std::string> &columns);
    /// Calls action(name, member) for all plain numbers of a checkpoint.
    template <typename Action>
    void
    for_each_number(const Action &action);

    SimulationParameters<dim> parameters;
    Base::Log                &log;
    MPI_Comm                  communicator;
    Base::Timing              timing;

    std::unique_ptr<Mesh::LocalRefinement<dim>> refinement; ///< or none
    std::unique_ptr<Mesh::DistributedMesh<dim>> mesh;
    unsigned int                                n_coarse_nodes       = 0;
    bool                                        hanging_is_announced = false;
    std::vector<Parameters::Feature>            region_features; ///< as given
    Coupling::BodyMaterials<dim>                materials;
    Bonds::CrackSet<dim>                        cracks;
    Mesh::RegionMap                             region;
    std::unique_ptr<Fem::Supports<dim>>         supports;
    std::unique_ptr<Fem::Loads<dim>>            loads;
    std::vector<Fem::FreeMotion<dim>>           free_motions;
    std::unique_ptr<PostProcessing<dim>>        post_processing;
    std::unique_ptr<Output::Results>            result;
    std::unique_ptr<Output::FieldOutput<dim>>   fields;
    std::vector<std::string>                    files;
    std::shared_ptr<Solvers::FactorMemory>      factor_memory; ///< of growth
    bool                                        point_supports_checked = false;

    // Growth of cracks.
    Output::CsvWriter  *growth_table = nullptr;
    unsigned int        n_advances   = 0;
    std::vector<double> recent_loads; ///< of the advances
    std::string         growth_end = "end of the loads";
    double released_energy = 0., dissipated_energy = 0., grown_length = 0.;
    double switched_energy = 0.; ///< change by the growth of the core

    // Breaking of bonds.
    Bonds::BrokenBonds                    broken;
    Coupling::FailurePlanes<dim>          failure_planes;
    std::unique_ptr<Damage::BreakingRule> breaking_rule;
    std::vector<bool>                     is_protected; ///< nodes
    Output::CsvWriter                    *broken_table   = nullptr;
    unsigned int                          n_events       = 0;
    unsigned int                          parts_at_start = 1;

    // From bonds to segments.
    bool         handed_over = false;
    unsigned int n_nucleated = 0;
    double hand_over_energy = 0., hand_over_crack = 0.; ///< change, length
    unsigned int hand_over_event = 0, solves_before = 0, segment_solves = 0;
    std::size_t  n_replaced = 0; ///< bonds that broke and lie at cracks now

    // Work of loads and supports, by the trapezoidal rule between states.
    State<dim> last_state;
    double     work        = 0.;
    bool       counts_work = true;

    // Motion.
    std::vector<double> node_mass;
    double              stable_time_step = 0.; ///< 0: not known
    double              announced_limit = 0., limit_at_start = 0.;
    /// Whether bonds broke since the limit was found, how long ago that was;
    /// at finite strain: the state, by what it may have fallen since, and what
    /// that has cost.
    bool                                limit_is_old   = false;
    unsigned int                        steps_of_limit = 0;
    std::vector<dealii::Tensor<1, dim>> displacement_of_limit;
    double                              limit_reduction = 1., steps_lost = 0.;
    double      energy_at_start = 0., largest_energy = 0.;
    double      largest_imbalance = 0.;                 ///< of energies
    double      latest_balance = 0., energy_drift = 0.; ///< relative
    std::size_t n_time_steps = 0;
    Fracture::AdvanceHistory advance_history;

    // Progress, tables by name, checkpoints.
    Progress progress;
    double   largest_force = 0.;
    std::map<std::string, std::unique_ptr<Output::CsvWriter>> tables;
    Output::CsvWriter                *quantity_table = nullptr;
    Output::Checkpoint                checkpoint; ///< the next one
    std::optional<Output::Checkpoint> resumed;    ///< until it is restored
    std::map<std::string, std::uintmax_t>
         earlier_tables; ///< sizes of those that are continued [bytes]
    bool checkpoint_is_announced = false;
  };
} // namespace Perimorph::Application
