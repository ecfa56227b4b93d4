#include "tessera/output/history.hpp"

#include <gtest/gtest.h>

#include "sample.hpp"
#include "tessera/base/error.hpp"

namespace tessera {
namespace {

const std::vector<Column> columns = {{"t", "s"}, {"kinetic", "J"}, {"punch.fx", "N"}};
const std::string header = "t[s],kinetic[J],punch.fx[N]\n";

TEST(History, WritesHeaderAndRowsWith17Digits) {
  const sample::Folder folder;
  History history(folder.file("history.csv"), columns);
  EXPECT_EQ(folder.read("history.csv"), header);
  history.append(std::vector<double>{0.0, 1.0 / 3.0, -0.1});
  // Read while the table is open: rows must not wait in a buffer.
  EXPECT_EQ(folder.read("history.csv"), header + "0,0.33333333333333331,-0.10000000000000001\n");
}

TEST(History, ARowPerTime) {
  const sample::Folder folder;
  History history(folder.file("history.csv"), columns);
  for (const double t : {0.0, 0.5, 0.5}) history.append(std::vector<double>{t, 1.0, 2.0});
  EXPECT_EQ(folder.read("history.csv"), header + "0,1,2\n0.5,1,2\n");
}

TEST(History, QuotesNamesThatNeedIt) {
  const sample::Folder folder;
  const History history(folder.file("history.csv"), {{"t", "s"}, {"a,\"b\".x", "m"}});
  EXPECT_EQ(folder.read("history.csv"), "t[s],\"a,\"\"b\"\".x[m]\"\n");
}

TEST(History, GoingOnKeepsRowsUpToTheTime) {
  const sample::Folder folder;
  folder.write("history.csv", header + "0,1,2\n0.10000000000000001,3,4\n0.2,5,6\n0.3,7");
  {
    History history(folder.file("history.csv"), columns, ContinueFrom{0.1});
    EXPECT_EQ(history.last_time(), 0.1);
    history.append(std::vector<double>{0.1, 0.0, 0.0});
    history.append(std::vector<double>{0.15, 8.0, 9.0});
  }
  EXPECT_EQ(folder.read("history.csv"), header + "0,1,2\n0.10000000000000001,3,4\n0.14999999999999999,8,9\n");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(History, GoingOnDropsARowThatWasCutShort) {
  const sample::Folder folder;
  folder.write("history.csv", header + "0,1,2\n0.1,3");
  const History history(folder.file("history.csv"), columns, ContinueFrom{5.0});
  EXPECT_EQ(folder.read("history.csv"), header + "0,1,2\n");
}

TEST(History, GoingOnWithoutATableBeginsAnew) {
  const sample::Folder folder;
  const History history(folder.file("history.csv"), columns, ContinueFrom{5.0});
  EXPECT_EQ(folder.read("history.csv"), header);
  EXPECT_FALSE(history.last_time());
}

TEST(History, OtherColumnsAreAnError) {
  const sample::Folder folder;
  folder.write("history.csv", "t[s],kinetic[J]\n0,1\n");
  EXPECT_EQ(sample::message_of<InputError>([&] { History(folder.file("history.csv"), columns, ContinueFrom{1.0}); }),
            folder.file("history.csv") +
                ":1:1: the columns are not those of this case; run the case as it was, or start again");
  EXPECT_EQ(folder.read("history.csv"), "t[s],kinetic[J]\n0,1\n");
}

TEST(History, ADamagedRowIsAnErrorWithItsLine) {
  for (const char* row : {"zero,1,2", "0.5,1", "0.5;1,2,3", ""}) {
    const sample::Folder folder;
    folder.write("history.csv", header + "0,1,2\n" + row + "\n");
    EXPECT_EQ(sample::message_of<InputError>([&] { History(folder.file("history.csv"), columns, ContinueFrom{1.0}); }),
              folder.file("history.csv") + ":3:1: not a row of this table; remove the line or start the run again")
        << row;
  }
}

TEST(History, ARowOfAnotherLengthIsRefused) {
  const sample::Folder folder;
  History history(folder.file("history.csv"), columns);
  EXPECT_THROW(history.append(std::vector<double>{0.0, 1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace tessera
