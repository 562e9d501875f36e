#include <perimorph/parameters/text_tools.h>

#include <gtest/gtest.h>

using namespace Perimorph::Parameters;
using Texts = std::vector<std::string>;

TEST(SplitTopLevel, respects_parentheses)
{
  EXPECT_EQ(split_top_level("x = max(0, t), y = (1, 2)", ','),
            (Texts{"x = max(0, t)", "y = (1, 2)"}));
}

TEST(SplitTopLevel, trims_and_keeps_empty_parts)
{
  EXPECT_EQ(split_top_level(" a ;; b ", ';'), (Texts{"a", "", "b"}));
  EXPECT_TRUE(split_top_level(" \t ", ';').empty());
}

TEST(SplitWords, skips_runs_of_separators)
{
  EXPECT_EQ(split_words(" 1, 2 ,3", " ,"), (Texts{"1", "2", "3"}));
  EXPECT_TRUE(split_words("").empty());
}

TEST(CondenseBlanks, leaves_one_blank)
{
  EXPECT_EQ(condense_blanks("  horizon \t  ratio\r"), "horizon ratio");
}

TEST(ParenthesesMatch, counts_in_order)
{
  EXPECT_TRUE(parentheses_match("(a(b))()"));
  EXPECT_FALSE(parentheses_match("(a"));
  EXPECT_FALSE(parentheses_match(")a("));
}

TEST(ToNumber, takes_the_whole_text_only)
{
  EXPECT_EQ(to_number("-1.5e3"), -1500.);
  EXPECT_FALSE(to_number("1.5 "));
  EXPECT_FALSE(to_number("2x"));
  EXPECT_FALSE(to_number(""));
  EXPECT_FALSE(to_number("nan"));
  EXPECT_FALSE(to_number("inf"));
  EXPECT_FALSE(to_number("1e999"));
  EXPECT_FALSE(to_number("0x10"));
}

TEST(ToCount, takes_digits_only)
{
  EXPECT_EQ(to_count("101"), 101u);
  EXPECT_FALSE(to_count("-1"));
  EXPECT_FALSE(to_count("1.0"));
  EXPECT_FALSE(to_count("99999999999"));
}

TEST(IsIdentifier, wants_a_letter_first)
{
  EXPECT_TRUE(is_identifier("tip_2"));
  EXPECT_FALSE(is_identifier("2tip"));
  EXPECT_FALSE(is_identifier("a b"));
  EXPECT_FALSE(is_identifier(""));
}
