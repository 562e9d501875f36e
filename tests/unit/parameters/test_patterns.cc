#include <perimorph/parameters/patterns.h>

#include <gtest/gtest.h>

using namespace Perimorph::Parameters;

TEST(OpenDouble, excludes_its_bounds)
{
  const OpenDouble pattern(-1., 0.5);
  EXPECT_TRUE(pattern.match("0.3"));
  EXPECT_FALSE(pattern.match("0.5"));
  EXPECT_FALSE(pattern.match("-1"));
  EXPECT_FALSE(pattern.match("0.3 m"));
  EXPECT_FALSE(pattern.match(""));
  EXPECT_EQ(plain_words(pattern.description()), "a number > -1 and < 0.5");
}

TEST(PositiveDouble, excludes_zero)
{
  const auto pattern = PositiveDouble().clone();
  EXPECT_TRUE(pattern->match(" 1e-300 "));
  EXPECT_FALSE(pattern->match("0"));
  EXPECT_FALSE(pattern->match("nan"));
  EXPECT_EQ(plain_words(pattern->description()), "a number > 0");
}

TEST(PlainWords, translate_the_patterns_of_deal_ii)
{
  namespace Patterns = dealii::Patterns;
  EXPECT_EQ(plain_words(Patterns::Double().description()), "a number");
  EXPECT_EQ(plain_words(Patterns::Double(0.).description()), "a number >= 0");
  EXPECT_EQ(plain_words(Patterns::Double(0., 0.5).description()),
            "a number from 0 to 0.5");
  EXPECT_EQ(plain_words(Patterns::Integer(1).description()),
            "a whole number >= 1");
  EXPECT_EQ(plain_words(Patterns::Integer().description()), "a whole number");
  EXPECT_EQ(plain_words(Patterns::Integer(2, 3).description()),
            "a whole number from 2 to 3");
  EXPECT_EQ(plain_words(Patterns::Bool().description()), "true, false");
  EXPECT_EQ(plain_words(Patterns::Anything().description()), "any text");
  EXPECT_EQ(plain_words(Patterns::FileName().description()), "a file name");
  EXPECT_EQ(plain_words(Patterns::List(Patterns::Double(0.)).description()),
            "a list, every part being a number >= 0");
}

TEST(SelectionNames, come_back_as_a_list)
{
  const std::vector<std::string>    names = {"plane stress", "plane strain"};
  const dealii::Patterns::Selection pattern(selection_text(names));
  EXPECT_EQ(selection_names(pattern.description()), names);
  EXPECT_EQ(plain_words(pattern.description()), "plane stress, plane strain");
  EXPECT_TRUE(selection_names("[Anything]").empty());
}
