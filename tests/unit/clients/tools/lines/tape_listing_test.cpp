#include "clients/tools/lines/tape_listing.hpp"

#include <gtest/gtest.h>
#include <span>
#include <string>

namespace dripline::wire {
namespace {

TEST(TapeListing, ShowsHolesValueAndMeaningHoweverItIsCut) {
  constexpr std::string_view kRows("\0\0\x0B\x80\x45\x10\x7F\x03\x0D\0", 10);
  const auto rows = std::as_bytes(std::span(kRows));
  std::string whole, pieces;
  TapeListing one(CharacterCode::Eia), many(CharacterCode::Eia);
  one.list(rows, whole);
  one.finish(whole);
  for (const auto row : rows) many.list({&row, 1}, pieces);
  many.finish(pieces);
  EXPECT_EQ(whole, pieces);
  EXPECT_EQ(whole,
            "         1  .....:...  00       blank, 2 rows\n"
            "         3  ....o:.oo  0B  %    rewind stop\n"
            "         4  o....:...  80       end of block\n"
            "         5  .o...:o.o  45  N\n"
            "         6  ...o.:...  10  SP\n"
            "         7  .oooo:ooo  7F       delete\n"
            "         8  .....:.oo  03       wrong parity\n"
            "         9  ....o:o.o  0D       no character of this code\n"
            "        10  .....:...  00       blank, 1 rows\n");
}

}  // namespace
}  // namespace dripline::wire
