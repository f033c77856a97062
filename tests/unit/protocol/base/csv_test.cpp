#include "protocol/base/csv.hpp"

#include <gtest/gtest.h>

namespace dripline {
namespace {

struct CellCase {
  const char* name;
  const char* text;
  const char* cell;
};
class CsvField : public testing::TestWithParam<CellCase> {};

TEST_P(CsvField, IsNoFormulaAndComesBack) {
  EXPECT_EQ(csv_field(GetParam().text), GetParam().cell);
  std::string cell = GetParam().cell;
  if (cell.starts_with('"')) {
    cell = cell.substr(1, cell.size() - 2);
    for (auto at = cell.find("\"\""); at != std::string::npos; at = cell.find("\"\"", at + 1))
      cell.erase(at, 1);
  }
  EXPECT_EQ(unguarded(cell), GetParam().text);
}
INSTANTIATE_TEST_SUITE_P(
    , CsvField,
    testing::Values(CellCase{"plain", "O0100", "O0100"}, CellCase{"empty", "", ""},
                    CellCase{"formula", "=HYPERLINK(\"http://x\",\"y\")",
                             "\"'=HYPERLINK(\"\"http://x\"\",\"\"y\"\")\""},
                    CellCase{"plus", "+A1", "'+A1"}, CellCase{"minus", "-A1", "'-A1"},
                    CellCase{"at", "@SUM(A1)", "'@SUM(A1)"}, CellCase{"tab", "\t=1", "\"'\t'=1\""},
                    CellCase{"carriage_return", "\r=1", "\"'\r'=1\""},
                    CellCase{"line_end", "\n=1", "\"'\n'=1\""},
                    CellCase{"negative_number", "-0.0125", "-0.0125"},
                    CellCase{"signed_number", "+49.987", "+49.987"},
                    CellCase{"two_points", "-1.2.3", "'-1.2.3"}, CellCase{"sign_alone", "-", "'-"},
                    CellCase{"exponent", "-1e5", "'-1e5"}, CellCase{"sum", "-1+1", "'-1+1"},
                    CellCase{"apostrophe", "'tis", "'tis"},
                    CellCase{"guarded_already", "'=1", "''=1"},
                    CellCase{"quoted", "a \"b\", c", "\"a \"\"b\"\", c\""},
                    CellCase{"semicolon", "a;b", "\"a;b\""},
                    CellCase{"formula_after_semicolon", "a;=1;", "\"a;'=1;\""},
                    CellCase{"formula_after_tab", "a\t@b", "\"a\t'@b\""},
                    CellCase{"formula_after_line", "a\r\n-b", "\"a\r\n'-b\""},
                    CellCase{"guarded_after_semicolon", "a;'=1", "\"a;''=1\""},
                    CellCase{"number_after_semicolon", "-1;-0.5", "\"'-1;-0.5\""},
                    CellCase{"quote_after_semicolon", "a;\"=1", "\"a;'\"\"=1\""},
                    CellCase{"comma", "a,-b", "\"a,-b\""}),
    [](const auto& i) { return std::string{i.param.name}; });

}  // namespace
}  // namespace dripline
