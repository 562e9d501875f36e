// perimorph_stability_study FILE.csv [2|3 [SWEEP]]
//
// Solves many small problems over the parameters that can harm stability and
// writes one row per combination; doc/stability/README.md defines the columns.

#include <perimorph/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include "stability_specimen.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <vector>

namespace Perimorph::Studies
{
  namespace
  {
    using Peridynamics::InfluenceFunction;
    using Influence = decltype(Combination::influence);

    /// Combinations of one sweep.
    struct Sweep
    {
      std::string              name;
      std::vector<Combination> combinations;
      bool of_bonds = true; ///< means something for bond-based peridynamics
    };

    template <typename Value>
    Sweep
    sweep(const std::string &name,
          Value Combination::      *member,
          const std::vector<Value> &values,
          const bool                of_bonds = true)
    {
      Sweep result{name, {}, of_bonds};
      for (const Value &value : values)
        {
          Combination combination;
          combination.*member = value;
          result.combinations.push_back(combination);
        }
      return result;
    }

    Sweep
    pairs(const std::string &name,
          double Combination::      *first,
          const std::vector<double> &first_values,
          double Combination::      *second,
          const std::vector<double> &second_values,
          const bool                 of_bonds = true)
    {
      Sweep result{name, {}, of_bonds};
      for (const double a : first_values)
        for (const double b : second_values)
          {
            Combination combination;
            combination.*first  = a;
            combination.*second = b;
            result.combinations.push_back(combination);
          }
      return result;
    }

    /// All parameters at random: a check of limits chosen from the others.
    Sweep
    random_sweep(const unsigned int n)
    {
      Sweep        result{"random", {}, true};
      std::mt19937 engine(17);
      const auto   number = [&](const double from, const double to) {
        // raw engine output: the same numbers with every standard library
        const double value = from + (to - from) * (engine() / 4294967295.);
        return std::round(100. * value) / 100.;
      };
      for (unsigned int k = 0; k < n; ++k)
        {
          Combination combination;
          combination.horizon_ratio  = number(1.2, 4.);
          combination.perturbation   = number(0., 0.35);
          combination.poissons_ratio = k % 2 == 0 ? 0.25 : number(-.3, .499);
          combination.influence = static_cast<InfluenceFunction>(engine() % 4);
          combination.aspect    = number(1., 4.);
          combination.grading   = number(1., 3.);
          combination.gamma     = number(0.1, 2.5);
          result.combinations.push_back(combination);
        }
      return result;
    }

    std::vector<Sweep>
    all_sweeps(const int dim)
    {
      using C                 = Combination;
      std::vector<Sweep> list = {
        sweep<double>("m", &C::horizon_ratio, {1.5, 2., 3., 4., 5.}),
        sweep<double>("perturbation",
                      &C::perturbation,
                      {0., .1, .2, .3, .35, .4}),
        sweep<double>("nu",
                      &C::poissons_ratio,
                      {-.5, 0., .25, .33, .45, .49, .499}),
        sweep<Influence>("influence",
                         &C::influence,
                         {InfluenceFunction::constant,
                          InfluenceFunction::triangular,
                          InfluenceFunction::cubic_spline,
                          InfluenceFunction::gaussian},
                         false),
        sweep<double>("aspect", &C::aspect, {1., 2., 4., 8.}),
        sweep<double>("grading", &C::grading, {1., 2., 4., 8.}),
        sweep<double>("gamma",
                      &C::gamma,
                      {0., .01, .1, .5, 1., 2., 5., 10.},
                      false),
        pairs("m x perturbation",
              &C::horizon_ratio,
              {1.5, 3., 5.},
              &C::perturbation,
              {0., .35}),
        pairs("m x gamma",
              &C::horizon_ratio,
              {1.5, 3., 5.},
              &C::gamma,
              {0., .1, 10.},
              false),
        pairs("nu x gamma",
              &C::poissons_ratio,
              {.45, .499},
              &C::gamma,
              {0., .1, 10.},
              false),
        pairs("m x aspect",
              &C::horizon_ratio,
              {1.5, 3., 5.},
              &C::aspect,
              {4., 8.}),
        pairs("m x grading",
              &C::horizon_ratio,
              {1.5, 3., 5.},
              &C::grading,
              {8.}),
      };
      // pairs would take too long in 3D
      if (dim == 3)
        list.erase(list.begin() + 7, list.end());
      list.push_back(random_sweep(dim == 2 ? 48 : 24));
      return list;
    }

    /// A number with few digits, so that the table does not change with the
    /// machine.
    std::string
    text(const double value)
    {
      std::ostringstream stream;
      stream << std::setprecision(3) << value;
      return stream.str();
    }

    /// The message of a refusal on one line.
    std::string
    one_line(std::string message)
    {
      for (char &character : message)
        if (character == '\n' || character == ',' || character == '"')
          character = character == '\n' ? ' ' : ';';
      return message;
    }

    /// Iterations of Newton's method, or why it failed.
    struct NewtonText
    {
      std::string text;
      bool        harmed;
    };

    template <int dim>
    NewtonText
    newton_text(const Specimen<dim> &specimen, const double stretch)
    {
      const auto outcome = specimen.move_top(stretch, 3);
      if (!outcome.failure.empty())
        return {one_line(outcome.failure), true};
      return {std::to_string(outcome.iterations) +
                (outcome.stable ? "" : " unstable"),
              !outcome.stable};
    }

    /// What is wrong with the linear problem, empty if nothing.
    std::string
    linear_harm(const Spectrum  &s,
                const double     ghost,
                const double     bending,
                const Reference &elements)
    {
      std::string list;
      const auto  add = [&](const bool wrong, const char *what) {
        if (wrong)
          list += (list.empty() ? "" : "; ") + std::string(what);
      };
      add(ghost > 1e-9, "ghost force");
      add(s.worst <= 0., "indefinite");
      add(s.worst > 0. && s.rough > 1.35 * elements.rough, "zero-energy modes");
      add(bending < 0.8, "locking");
      add(std::abs(bending - 1.) > std::abs(elements.bending - 1.) + 0.1,
          "bending worse than finite elements");
      return list;
    }

    /// The columns behind the parameters.
    template <int dim>
    std::string
    measure(const Combination &combination,
            const Method       method,
            const Reference   &elements)
    {
      const Specimen<dim> block(combination,
                                method,
                                Shape::block,
                                Law::small_strain);
      const double        ghost = block.ghost_force();
      const auto          s     = spectrum(block, elements);
      const double        bending =
        Specimen<dim>(combination, method, Shape::beam, Law::small_strain)
          .bending_ratio();
      const Specimen<dim> finite(combination,
                                 method,
                                 Shape::block,
                                 Law::finite_strain);
      const auto          pulled = newton_text(finite, 0.3);
      const auto          pushed = newton_text(finite, -0.3);

      std::string harm = linear_harm(s, ghost, bending, elements);
      if (pulled.harmed || pushed.harmed)
        harm += std::string(harm.empty() ? "" : "; ") + "finite strain";
      std::string warnings;
      for (const auto &warning : finite.warnings())
        warnings += (warnings.empty() ? "" : "; ") + warning;
      const auto         shapes = finite.cell_shapes();
      std::ostringstream row;
      row << text(shapes.aspect) << ',' << text(shapes.spacing_ratio) << ','
          << (ghost < 1e-11 ? "0" : text(ghost)) << ',' << text(s.softest)
          << ',' << text(s.worst) << ',' << text(s.largest) << ','
          << text(s.rough) << ',' << text(elements.rough) << ','
          << text(bending) << ',' << text(elements.bending) << ','
          << pulled.text << ',' << pushed.text << ',' << harm << ','
          << (warnings.empty() ? "runs" : "warns: " + one_line(warnings));
      return row.str();
    }

    /// The parameters of a row.
    std::string
    parameter_text(const Combination &combination)
    {
      std::ostringstream row;
      row << combination.horizon_ratio << ',' << combination.perturbation << ','
          << combination.poissons_ratio << ','
          << (combination.influence
                ? Peridynamics::influence_function_names()[static_cast<int>(
                    *combination.influence)]
                : "automatic")
          << ',' << combination.aspect << ',' << combination.grading << ','
          << combination.gamma;
      return row.str();
    }

    template <int dim>
    void
    run(std::ostream &table, const std::string &only)
    {
      // the base point is in every sweep
      std::map<std::string, std::string> known;
      for (const auto &sweep : all_sweeps(dim))
        if (only.empty() || sweep.name == only)
          for (const auto &combination : sweep.combinations)
            {
              std::unique_ptr<Reference> elements;
              for (const Method method : {Method::correspondence,
                                          Method::correspondence_coupled,
                                          Method::bond_based,
                                          Method::bond_based_coupled})
                {
                  if (is_bond_based(method) && !sweep.of_bonds)
                    continue;
                  const auto parameters = parameter_text(combination);
                  auto      &row = known[method_name(method) + parameters];
                  try
                    {
                      if (row.empty() && !elements)
                        elements = std::make_unique<Reference>(
                          finite_element_reference<dim>(combination));
                      if (row.empty())
                        row = measure<dim>(combination, method, *elements);
                    }
                  catch (const Base::InputError &error)
                    {
                      row = ",,,,,,,,,,,,,refuses: " + one_line(error.what());
                    }
                  table << dim << ',' << method_name(method) << ','
                        << sweep.name << ',' << parameters << ',' << row
                        << std::endl;
                }
            }
    }
  } // namespace
} // namespace Perimorph::Studies

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc < 2)
    {
      std::cerr << "usage: perimorph_stability_study FILE.csv [2|3 [SWEEP]]\n";
      return 2;
    }
  std::ofstream table(argv[1]);
  table << "dimension,method,sweep,m,perturbation,nu,influence,aspect,grading,"
           "gamma,cell_aspect,spacing_ratio,ghost_force,softest,worst,largest,"
           "rough,rough_elements,bending,bending_elements,newton_pulled,"
           "newton_pushed,harm,program\n";
  if (argc < 3 || std::strcmp(argv[2], "2") == 0)
    Perimorph::Studies::run<2>(table, argc > 3 ? argv[3] : "");
  if (argc < 3 || std::strcmp(argv[2], "3") == 0)
    Perimorph::Studies::run<3>(table, argc > 3 ? argv[3] : "");
  return table ? 0 : 1;
}
