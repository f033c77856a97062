#include "gateway/interpreter/dialects/fanuc/memory/variable_names.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/reading/block_reader.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/expression_reader.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/keywords.hpp"

namespace dripline::interpreter::fanuc {
namespace {

constexpr std::size_t kMaxVariableName = 8;

struct SystemName {
  std::string_view name;
  int number;     ///< of index 1 where there are several
  int count = 0;  ///< 0: no index
};
/// Those whose variables this interpreter has.
constexpr std::array kSystemNames{
    SystemName{"_ALM", 3000},          SystemName{"_CLOCK1", 3001},
    SystemName{"_CLOCK2", 3002},       SystemName{"_CNTL1", 3003},
    SystemName{"_CNTL2", 3004},        SystemName{"_SETDT", 3005},
    SystemName{"_MSGSTP", 3006},       SystemName{"_MRIMG", 3007},
    SystemName{"_DATE", 3011},         SystemName{"_TIME", 3012},
    SystemName{"_PRTSA", 3901},        SystemName{"_PRTSN", 3902},
    SystemName{"_ABSIO", 100'001, 50}, SystemName{"_ABSMT", 100'051, 50},
    SystemName{"_ABSOT", 100'101, 50}, SystemName{"_ABSKP", 100'151, 50},
    SystemName{"_WZCMN", 100'301, 50}, SystemName{"_WZG54", 100'351, 50},
    SystemName{"_WZG55", 100'401, 50}, SystemName{"_WZG56", 100'451, 50},
    SystemName{"_WZG57", 100'501, 50}, SystemName{"_WZG58", 100'551, 50},
    SystemName{"_WZG59", 100'601, 50}};

bool refuse_name(Run& run, const char* at, std::string_view name, std::string_view why) {
  return run.fail(ErrorCode::IllegalVariable, run.column(at), fmt::format("[#{}]: {}", name, why));
}

std::string_view take_name(const char*& at) {
  const char* begin = at;
  while (is_name_character(*at)) ++at;
  return {begin, static_cast<std::size_t>(at - begin)};
}

bool read_index(Run& run, const char*& at, std::string_view name, int count, int& index) {
  const char* start = at;
  double value = 0;
  if (!read_operand(run, at, 1, value)) return false;
  if (!(value >= 1 && value <= count && value == std::trunc(value)))
    return refuse_name(run, start, name, fmt::format("its index is 1 to {}", count));
  index = static_cast<int>(value);
  return true;
}

bool find_system(Run& run, const char* start, const char*& at, std::string_view name, int& number) {
  const auto* row = std::find_if(kSystemNames.begin(), kSystemNames.end(),
                                 [name](const SystemName& each) { return each.name == name; });
  if (row == kSystemNames.end())
    return refuse_name(run, start, name, "a system variable of this name is not known here");
  number = row->number;
  const bool has_index = *at == '[';
  if (has_index != (row->count != 0))
    return refuse_name(run, start, name, has_index ? "it has no index" : "an index is missing");
  int index = 1;
  if (has_index && !read_index(run, at, name, row->count, index)) return false;
  number += index - 1;
  return true;
}

bool find_common(Run& run, const char* start, std::string_view name, int& number) {
  const auto& names = run.state.variable_names;
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    return refuse_name(run, start, name, "no SETVN of this run gives a variable the name");
  number = kFirstNamed + static_cast<int>(at - names.begin());
  return true;
}

/// Calls `take` with each name between the brackets; false as soon as it is.
template <class Take>
bool for_each_name(const char* at, const char* end, Take take) {
  for (;;) {
    at = skip_blanks(at);
    const char* begin = at;
    const std::string_view name = take_name(at);
    at = skip_blanks(at);
    if (!take(begin, at == end || *at == ',' ? name : std::string_view{})) return false;
    if (at == end) return true;
    ++at;
  }
}

}  // namespace

bool is_named_variable(const char* at) {
  if (*at != '[') return false;
  at = skip_blanks(at + 1);
  if (*at != '#') return false;
  at = skip_blanks(at + 1);
  return is_letter(*at) || *at == '_';
}

bool read_variable_name(Run& run, const char*& at, int& number) {
  const char* start = at;
  if (!run.options.has_long_variables)
    return run.fail(ErrorCode::MacroFormat, run.column(at), "a name of a variable on this model");
  at = skip_blanks(skip_blanks(at + 1) + 1);
  const std::string_view name = take_name(at);
  skip_gaps(run, at);
  const bool is_found = name.front() == '_' ? find_system(run, start, at, name, number)
                                            : find_common(run, start, name, number);
  if (!is_found) return false;
  skip_gaps(run, at);
  if (*at != ']') return run.fail(ErrorCode::MacroFormat, run.column(at), "] is expected here");
  ++at;
  return true;
}

bool read_naming(Run& run, const char* start, const char*& at) {
  if (!run.options.has_long_variables)
    return run.fail(ErrorCode::MacroFormat, run.column(start), "SETVN on this model");
  double first = 0;
  if (!read_operand(run, at, 1, first)) return false;
  skip_gaps(run, at);
  const char* end = std::find(at, find_block_end(run, at), ']');
  if (*at != '[' || *end != ']')
    return run.fail(ErrorCode::MacroFormat, run.column(at), "SETVN n[NAME,NAME]");
  double last = first - 1;
  const char* begin = ++at;
  at = end + 1;
  const bool is_good = for_each_name(begin, end, [&](const char* place, std::string_view name) {
    ++last;
    if (!name.empty() && name.size() <= kMaxVariableName && is_letter(name.front())) return true;
    return run.fail(ErrorCode::MacroFormat, run.column(place),
                    "a name of a variable has 1 to 8 characters, A to Z first");
  });
  if (!is_good) return false;
  if (!(first >= kFirstNamed && last < kFirstNamed + kNamedCount && first == std::trunc(first)))
    return run.fail(ErrorCode::IllegalVariable, run.column(start), "SETVN names #500 to #549");
  Block::Parts& parts = run.block.parts;
  parts.statement = StatementKind::Name;
  parts.variable = static_cast<std::int32_t>(first);
  parts.message_begin = run.offset(begin);
  parts.message_end = run.offset(end);
  return true;
}

bool name_variables(Run& run) {
  const Block::Parts& parts = run.block.parts;
  auto& names = run.state.variable_names;
  names.resize(kNamedCount);
  const char* text = run.text.begin();
  std::size_t place = static_cast<std::size_t>(parts.variable - kFirstNamed);
  return for_each_name(text + parts.message_begin, text + parts.message_end,
                       [&](const char* at, std::string_view name) {
                         names[place].clear();
                         if (std::find(names.begin(), names.end(), name) != names.end())
                           return refuse_name(run, at, name, "another variable has this name");
                         names[place++] = name;
                         return true;
                       });
}

}  // namespace dripline::interpreter::fanuc
