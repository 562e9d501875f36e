#include <perimorph/application/checkpoint.h>
#include <perimorph/application/run.h>
#include <perimorph/application/simulation.h>
#include <perimorph/base/collective.h>
#include <perimorph/base/log.h>
#include <perimorph/parameters/command_line.h>
#include <perimorph/parameters/overrides.h>
#include <perimorph/parameters/reader.h>

#include <deal.II/base/mpi.h>

#include <iostream>
#include <sstream>

namespace Perimorph::Application
{
  namespace
  {
    enum ExitCode
    {
      done         = 0,
      bad_input    = 2,
      solve_failed = 3
    };

    /// Commented, in the order of a run.
    const auto print_style = dealii::ParameterHandler::PRM |
                             dealii::ParameterHandler::KeepDeclarationOrder;

    template <int dim>
    void
    run_dimension(const Parameters::CommandLine &command_line,
                  ParameterTexts                &texts,
                  dealii::ParameterHandler      &prm,
                  Base::InputErrorCollector     &errors,
                  Base::Log                     &log,
                  const MPI_Comm                 communicator)
    {
      SimulationParameters<dim> parameters(texts,
                                           command_line.parameter_file,
                                           errors);
      errors.throw_if_any();
      if (!command_line.output.empty())
        parameters.output_folder = command_line.output;
      Output::Checkpoint earlier;
      if (!command_line.resume.empty())
        {
          parameters.output_folder = command_line.resume;
          const auto file          = checkpoint_file(command_line.resume);
          Base::collectively(communicator, [&]() {
            earlier = Output::read_checkpoint(file);
          });
          compare_parameters(prm, earlier, file, errors);
          errors.throw_if_any();
        }
      log << "Perimorph " << PERIMORPH_VERSION << ": " << parameters.case_name
          << " (" << dim << "D, "
          << dealii::Utilities::MPI::n_mpi_processes(communicator) << " rank"
          << (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1 ? "s"
                                                                        : "")
          << ")" << std::endl;
      Simulation<dim> simulation(parameters, log, communicator);
      simulation.prepare();
      if (!command_line.validate)
        simulation.refine_by_error();
      if (!command_line.resume.empty())
        simulation.resume(earlier);
      if (command_line.validate)
        {
          simulation.report_validation();
          return;
        }
      std::ostringstream parameters_text;
      prm.print_parameters(parameters_text, print_style);
      Output::Checkpoint constants;
      store_parameters(prm, constants);
      simulation.run(parameters_text.str(), constants);
    }

    void
    run_checked(const int argc, char **argv, const MPI_Comm communicator)
    {
      const bool first =
        dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
      const auto command_line = Parameters::parse_command_line(argc, argv);
      if (command_line.help || command_line.version)
        {
          if (first)
            std::cout << (command_line.help ? Parameters::help_text()
                                            : "Perimorph " PERIMORPH_VERSION
                                              "\n");
          return;
        }
      ParameterTexts           texts;
      dealii::ParameterHandler prm;
      texts.declare(prm);
      Base::InputErrorCollector errors;
      if (!command_line.parameter_file.empty() &&
          !Parameters::read_file(command_line.parameter_file, prm, errors))
        errors.throw_if_any();
      Parameters::apply_overrides(command_line.overrides, prm, errors);
      if (command_line.print_parameters)
        {
          errors.throw_if_any();
          if (first)
            prm.print_parameters(std::cout, print_style);
          return;
        }
      Base::Log log(communicator);
      if (texts.dimension == 2)
        run_dimension<2>(command_line, texts, prm, errors, log, communicator);
      else
        run_dimension<3>(command_line, texts, prm, errors, log, communicator);
    }
  } // namespace

  int
  run_program(const int argc, char **argv, const MPI_Comm communicator)
  {
    const bool first =
      dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    try
      {
        run_checked(argc, argv, communicator);
        return done;
      }
    catch (const Base::InputError &error)
      {
        if (first)
          std::cerr << error.what() << std::endl;
        return bad_input;
      }
    catch (const Base::SolveError &error)
      {
        if (first)
          std::cerr << "Error: the solve failed: " << error.what() << std::endl;
        return solve_failed;
      }
    catch (const std::exception &error)
      {
        // A defect of the program: no rank may go on waiting for this one.
        std::cerr << "Error: internal failure, please report it: "
                  << error.what() << std::endl;
        if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
          MPI_Abort(communicator, solve_failed);
        return solve_failed;
      }
  }
} // namespace Perimorph::Application
