#include <perimorph/base/exceptions.h>

#include <gtest/gtest.h>

using namespace Perimorph::Base;

TEST(InputMessage, puts_four_facts_into_two_lines)
{
  const InputMessage message{"parameter 'Peridynamics / horizon ratio'",
                             "0.5",
                             "more than 1",
                             "Usual value: 3"};
  EXPECT_EQ(message.text(),
            "parameter 'Peridynamics / horizon ratio'\n"
            "  found 0.5; allowed: more than 1. Usual value: 3");
}

TEST(InputMessage, leaves_out_what_is_empty)
{
  EXPECT_EQ((InputMessage{"the mesh", "no cells", "", ""}.text()),
            "the mesh\n  found no cells");
  EXPECT_EQ((InputMessage{"the mesh", "", "", "Is it closed?"}.text()),
            "the mesh\n  Is it closed?");
  EXPECT_EQ((InputMessage{"the mesh is empty", "", "", ""}.text()),
            "the mesh is empty");
}

TEST(InputError, prints_every_message_behind_error)
{
  const InputError error(std::vector<std::string>{"first", "second"});
  EXPECT_STREQ(error.what(), "Error: first\nError: second");
  EXPECT_EQ(error.messages().size(), 2u);
}

TEST(InputErrorCollector, throws_all_messages_at_once)
{
  InputErrorCollector errors;
  EXPECT_NO_THROW(errors.throw_if_any());
  errors.add("first");
  errors.add(InputMessage{"second", "a", "b", ""});
  try
    {
      errors.throw_if_any();
      FAIL() << "nothing thrown";
    }
  catch (const InputError &error)
    {
      EXPECT_STREQ(error.what(),
                   "Error: first\nError: second\n  found a; allowed: b");
    }
}

TEST(InputErrorCollector, names_the_origin_of_a_parameter)
{
  InputErrorCollector errors;
  errors.remember_origin("Material / law", "plate.prm:12");
  errors.add_parameter("Material / law", "'x'", "linear elastic");
  errors.add_parameter("Mode", "'x'", "coupled");
  EXPECT_EQ(errors.messages()[0],
            "parameter 'Material / law' in plate.prm:12\n"
            "  found 'x'; allowed: linear elastic");
  EXPECT_EQ(errors.messages()[1],
            "parameter 'Mode'\n  found 'x'; allowed: coupled");
}

TEST(SolveError, is_no_input_error)
{
  EXPECT_THROW(throw SolveError("step 3"), std::runtime_error);
  EXPECT_STREQ(SolveError("step 3").what(), "step 3");
}
