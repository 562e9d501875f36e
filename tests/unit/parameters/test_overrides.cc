#include <perimorph/parameters/overrides.h>

#include <deal.II/base/parameter_handler.h>

#include <gtest/gtest.h>

using namespace Perimorph;
using namespace Perimorph::Parameters;

namespace
{
  class Overrides : public testing::Test
  {
  protected:
    Overrides()
    {
      prm.add_parameter("Title", title);
      prm.enter_subsection("Boundary conditions");
      prm.add_parameter("displacement", displacement);
      prm.add_parameter("count", count, "", dealii::Patterns::Integer(1));
      prm.leave_subsection();
    }

    void
    expect_only(const std::string &text, const std::string &message)
    {
      apply_overrides({text}, prm, errors);
      ASSERT_EQ(errors.size(), 1u) << text;
      EXPECT_EQ(errors.messages()[0], message);
    }

    dealii::ParameterHandler  prm;
    Base::InputErrorCollector errors;
    std::string               title;
    std::string               displacement;
    int                       count = 1;
  };
} // namespace

TEST_F(Overrides, set_entries_whatever_the_blanks)
{
  apply_overrides({"Title=a",
                   " Boundary  conditions / displacement = top: x = 1/2 ",
                   "Boundary conditions/count=2",
                   "Boundary conditions/count=3"},
                  prm,
                  errors);
  EXPECT_TRUE(errors.empty());
  EXPECT_EQ(title, "a");
  EXPECT_EQ(displacement, "top: x = 1/2");
  EXPECT_EQ(count, 3);
}

TEST_F(Overrides, check_the_pattern)
{
  expect_only("Boundary conditions/count=0",
              "parameter 'Boundary conditions / count' in --set\n  found "
              "'0'; allowed: a whole number >= 1");
}

TEST_F(Overrides, want_an_equals_sign)
{
  expect_only("Title a",
              "--set 'Title a'\n  found no '='; allowed: --set "
              "\"Section/entry=value\"");
}

TEST_F(Overrides, want_an_entry)
{
  expect_only("=a",
              "--set '=a'\n  found no entry before '='; allowed: --set "
              "\"Section/entry=value\"");
}

TEST_F(Overrides, name_the_nearest_section)
{
  expect_only("Boundary condition/count=2",
              "--set 'Boundary condition/count=2': section 'Boundary "
              "condition' is not known; did you mean 'Boundary conditions'? "
              "It has: Boundary conditions");
}

TEST_F(Overrides, say_where_an_entry_belongs)
{
  expect_only("count=2",
              "--set 'count=2': entry 'count' is not known in the top level; "
              "entry 'count' belongs in section 'Boundary conditions'");
}
