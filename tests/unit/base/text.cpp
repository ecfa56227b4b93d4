#include "tessera/base/text.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace tessera {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("jiter", "jitter"), 1);
  EXPECT_EQ(edit_distance("sni", "sin"), 1);
  EXPECT_EQ(edit_distance("Young", "young"), 0);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(NearestWord, FindsWhatWasMeant) {
  const std::vector<std::string> words = {"density", "poisson", "young", "end"};
  EXPECT_EQ(nearest_word("densty", words), "density");
  EXPECT_EQ(nearest_word("posion", words), "poisson");
  EXPECT_EQ(nearest_word("ende", words), "end");
}

TEST(NearestWord, DoesNotGuessWildly) {
  const std::vector<std::string> words = {"density", "poisson", "t"};
  EXPECT_FALSE(nearest_word("colour", words));
  EXPECT_FALSE(nearest_word("x", words));
  EXPECT_FALSE(nearest_word("density", {}));
}

TEST(DidYouMean, IsEmptyWithoutACandidate) {
  const std::vector<std::string> words = {"density"};
  EXPECT_EQ(did_you_mean("densty", words), " (did you mean \"density\"?)");
  EXPECT_EQ(did_you_mean("colour", words), "");
}

TEST(ListOf, JoinsWords) {
  const std::vector<std::string> three = {"a", "b", "c"};
  EXPECT_EQ(list_of({}), "");
  EXPECT_EQ(list_of(std::vector<std::string>{"a"}), "a");
  EXPECT_EQ(list_of(three), "a, b or c");
  EXPECT_EQ(list_of(three, "and"), "a, b and c");
}

TEST(Quoted, StaysOnOneLine) {
  EXPECT_EQ(quoted(std::string("a\"b\\c\nd\te\x01")), "\"a\\\"b\\\\c\\nd\\te\\u0001\"");
  EXPECT_EQ(quoted("\xc2\xb5m"), "\"\xc2\xb5m\"");
}

TEST(QuotedList, QuotesEveryWord) {
  EXPECT_EQ(quoted_list(std::vector<std::string>{"a", "b"}), "\"a\" or \"b\"");
  EXPECT_EQ(quoted_list(std::vector<std::string>{"a", "b"}, "and"), "\"a\" and \"b\"");
}

TEST(Trimmed, RemovesBlanksAtTheEnds) {
  EXPECT_EQ(trimmed(" \t a b  "), "a b");
  EXPECT_EQ(trimmed("  "), "");
}

}  // namespace
}  // namespace tessera
