#include <perimorph/base/log.h>
#include <perimorph/output/results.h>
#include <perimorph/output/summary.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace Perimorph;

namespace
{
  std::string
  summary_of(const Output::Results &results, const std::string &warning = "")
  {
    std::ostringstream console;
    Base::Log          log(MPI_COMM_SELF, console);
    if (!warning.empty())
      log.warning(warning);
    Base::Timing timing(MPI_COMM_SELF);
    {
      const auto timer = timing.scope("assembly");
    }
    Output::print_summary(log,
                          results,
                          "output/plate",
                          {"results.json", "solution.pvd"},
                          timing,
                          timing.table());
    return console.str();
  }


  bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace


TEST(Summary, ShowsQuantitiesWithReferenceAndSignedError)
{
  Output::Results results("plate", "coupled", "0.1", 1);
  results.set_status(Output::Status::converged);
  results.set_quantity("stress_concentration", 3.03);
  results.set_reference("stress_concentration", 3.);
  results.set_companion_quantity("stress_concentration", 3.0300003);
  results.set_quantity("deflection", -0.25, "mm");
  results.set_quantity("midplane_stress", 1e-9, "MPa");
  results.set_reference("midplane_stress", 0.);
  results.set("counts", "broken_bonds", 7);
  results.set("checks", "ghost_force", 1.25e-14);
  results.set_peak_memory(321.4, 640.);
  const std::string text = summary_of(results, "coarse mesh");

  EXPECT_TRUE(contains(text, "Case plate, mode coupled: converged")) << text;
  EXPECT_TRUE(contains(text, "  7 broken bonds\n")) << text;
  EXPECT_TRUE(contains(text,
                       "  stress_concentration          3.03"
                       "                 3    +1.00 %"
                       "          3.03 -9.9e-06 %\n"))
    << text;
  EXPECT_TRUE(contains(text, "  deflection                   -0.25 mm\n"))
    << text;
  EXPECT_TRUE(contains(text, "             0          -\n")) << text;
  EXPECT_TRUE(contains(text, "ghost force          1.25e-14\n")) << text;
  EXPECT_FALSE(contains(text, "imbalance")) << text;
  EXPECT_TRUE(contains(text, "  assembly ")) << text;
  EXPECT_TRUE(contains(text, "321 MB\n")) << text;
  EXPECT_TRUE(contains(text, "Warnings\n  - coarse mesh\n")) << text;
  EXPECT_TRUE(contains(text,
                       "Written to output/plate:\n  results.json, "
                       "solution.pvd\n"))
    << text;
}


TEST(Summary, LeavesOutWhatThereIsNot)
{
  const std::string text =
    summary_of(Output::Results("plate", "coupled", "0.1", 1));
  EXPECT_TRUE(contains(text, ": failed\n")) << text;
  for (const char *part :
       {"Quantities", "reference", "Checks", "Solver", "Warnings", "Not done"})
    EXPECT_FALSE(contains(text, part)) << text;
}
