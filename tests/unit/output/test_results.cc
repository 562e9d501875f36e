#include <perimorph/base/log.h>
#include <perimorph/output/csv_writer.h>
#include <perimorph/output/results.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

using namespace Perimorph;
using Json = nlohmann::ordered_json;

namespace
{
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();

  /// A file of this process alone: the same tests may run at the same time on
  /// other numbers of ranks.
  std::string
  own(const std::string &name)
  {
    return std::to_string(getpid()) + "_" + name;
  }


  std::string
  contents(const std::string &filename)
  {
    std::ifstream     file(filename);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }


  Output::Results
  empty_results()
  {
    return Output::Results("plate_with_hole", "coupled", "0.1", 2);
  }
} // namespace


TEST(Results, HoldTheContractBeforeAnythingIsSet)
{
  const Json json = Json::parse(empty_results().to_json({}));
  EXPECT_EQ(json["case"], "plate_with_hole");
  EXPECT_EQ(json["mode"], "coupled");
  EXPECT_EQ(json["status"], "failed");
  EXPECT_EQ(json["perimorph_version"], "0.1");
  EXPECT_EQ(json["ranks"], 2);
  EXPECT_EQ(json["counts"].size(), 9u);
  EXPECT_EQ(json["counts"]["bonds"], 0);
  EXPECT_TRUE(json["checks"]["ghost_force"].is_null());
  EXPECT_EQ(json["timings"].size(), 6u);
  for (const char *name : {"quantities", "companion", "solver", "skipped"})
    EXPECT_TRUE(json.at(name).is_object()) << name;
  EXPECT_TRUE(json["warnings"].empty());
}


TEST(Results, QuantitiesKeepTheOrderInWhichTheyCame)
{
  auto results = empty_results();
  results.set_quantity("zeta", 1.);
  results.set_quantity("alpha", 2., "MPa");
  results.set_quantity("zeta", 3., "mm");
  EXPECT_EQ(results.names(), std::vector<std::string>({"zeta", "alpha"}));
  const Json json = Json::parse(results.to_json({}));
  EXPECT_EQ(json["quantities"].begin().key(), "zeta");
  EXPECT_EQ(json["quantities"]["zeta"]["value"], 3.);
  EXPECT_EQ(json["quantities"]["zeta"]["unit"], "mm");
  EXPECT_TRUE(json["quantities"]["zeta"]["reference"].is_null());
}


TEST(Results, ReferenceGivesTheRelativeErrorWhicheverComesFirst)
{
  auto results = empty_results();
  results.set_reference("deflection", -2.);
  results.set_quantity("deflection", -1.9);
  results.set_quantity("reaction", 0.1);
  results.set_reference("reaction", 0.);
  results.set_reference("stres_concentration", 3.);
  const Json json = Json::parse(results.to_json({}));
  EXPECT_NEAR(json["quantities"]["deflection"]["relative_error"], 0.05, 1e-15);
  EXPECT_TRUE(json["quantities"]["reaction"]["relative_error"].is_null());
  EXPECT_EQ(json["quantities"]["reaction"]["reference"], 0.);
  EXPECT_EQ(results.unmatched_references(),
            std::vector<std::string>({"stres_concentration"}));
}


TEST(Results, UnknownQuantityNamesTheNearest)
{
  auto results = empty_results();
  results.set_quantity("stress_concentration", 3.);
  EXPECT_TRUE(results.has("stress_concentration"));
  EXPECT_FALSE(results.has("stres_concentration"));
  try
    {
      results.value("stres_concentration");
      FAIL() << "nothing was thrown";
    }
  catch (const std::out_of_range &error)
    {
      EXPECT_NE(
        std::string(error.what()).find("did you mean 'stress_concentration'"),
        std::string::npos);
    }
}


TEST(Results, CompanionKnowsItsDifference)
{
  auto results = empty_results();
  results.set_quantity("stress_concentration", 3.03);
  results.set_companion_quantity("stress_concentration", 3.);
  results.set("companion", "relative_displacement_difference", 1e-3);
  const Json companion = Json::parse(results.to_json({}))["companion"];
  EXPECT_NEAR(
    companion["quantities"]["stress_concentration"]["relative_difference"],
    0.01,
    1e-12);
  EXPECT_EQ(companion["relative_displacement_difference"], 1e-3);
}


TEST(Results, SectionsTakeNumbersWordsAndNewNames)
{
  auto results = empty_results();
  results.set("counts", "nodes", 10u);
  results.add_count("newton_iterations", 3);
  results.add_count("newton_iterations", 4);
  results.set("solver", "linear_solver", "iterative");
  results.set("fracture", "grown", true);
  const Json json = Json::parse(results.to_json({}));
  EXPECT_EQ(json["counts"]["nodes"].dump(), "10");
  EXPECT_EQ(json["counts"]["newton_iterations"].dump(), "7");
  EXPECT_EQ(json["solver"]["linear_solver"], "iterative");
  EXPECT_EQ(json["fracture"]["grown"], true);
  EXPECT_EQ(results.number("counts", "nodes"), 10.);
  EXPECT_FALSE(results.number("checks", "ghost_force"));
  EXPECT_EQ(results.entries("checks").size(), 0u);
}


TEST(Results, NumbersThatAreNotFiniteBecomeNullWithAWarning)
{
  auto results = empty_results();
  results.set_status(Output::Status::stopped);
  results.set_quantity("good", 0.1);
  results.set_quantity("bad", not_a_number);
  results.set("checks", "imbalance", std::numeric_limits<double>::infinity());

  std::ostringstream console;
  Base::Log          log(MPI_COMM_WORLD, console);
  results.write(own("test_results.json"), log);
  EXPECT_EQ(log.warnings().size(), 2u);
  if (!log.is_active())
    return;
  const Json json = Json::parse(contents(own("test_results.json")));
  EXPECT_TRUE(json["quantities"]["bad"]["value"].is_null());
  EXPECT_TRUE(json["checks"]["imbalance"].is_null());
  EXPECT_EQ(json["quantities"]["good"]["value"].get<double>(), 0.1);
  EXPECT_EQ(json["status"], "stopped");
  EXPECT_EQ(json["warnings"].size(), 2u);
  EXPECT_FALSE(std::ifstream(own("test_results.json.part")).good());
  std::remove(own("test_results.json").c_str());
}


TEST(CsvWriter, NumbersReadBackExactly)
{
  EXPECT_EQ(Output::shortest_text(0.1), "0.1");
  EXPECT_EQ(Output::shortest_text(1.), "1");
  for (const double value : {1. / 3., 1e-300, -2.5e17, 192e3})
    EXPECT_EQ(std::stod(Output::shortest_text(value)), value);
  EXPECT_EQ(Output::shortest_text(not_a_number), "nan");
}


TEST(CsvWriter, RowsAreInTheFileAtOnce)
{
  std::ostringstream console;
  Base::Log          log(MPI_COMM_WORLD, console);
  Output::CsvWriter  table(own("test_table.csv"),
                          {"step", "time", "reason"},
                          log);
  table.write_row({1u, 0.5, "converged"});
  table.write_row({2, 1., "no, \"not\" yet"});
  EXPECT_THROW(table.write_row({3, 2.}), std::logic_error);
  if (!log.is_active())
    return;
  EXPECT_EQ(contents(own("test_table.csv")),
            "step,time,reason\n1,0.5,converged\n2,1,\"no, \"\"not\"\" yet\"\n");
  std::remove(own("test_table.csv").c_str());
}
