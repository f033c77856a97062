#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

/// The choices of the miscellaneous screen and what each one posts.
namespace dripline::conversational {

struct PostedChoice {
  std::string_view name, posted;
};

inline constexpr std::array kFeedModes{PostedChoice{"none", ""}, PostedChoice{"revolution", "G99"},
                                       PostedChoice{"minute", "G98"}};
inline constexpr std::array kSpindleModes{
    PostedChoice{"none", ""}, PostedChoice{"surface speed", "G96"}, PostedChoice{"rpm", "G97"}};
inline constexpr std::array kGears{PostedChoice{"none", ""}, PostedChoice{"low", "M41"},
                                   PostedChoice{"medium", "M42"}, PostedChoice{"high", "M43"}};
inline constexpr std::array kSpindles{PostedChoice{"none", ""}, PostedChoice{"cw", "M3"},
                                      PostedChoice{"ccw", "M4"}, PostedChoice{"off", "M5"}};
inline constexpr std::array kCoolants{PostedChoice{"none", ""}, PostedChoice{"on", "M8"},
                                      PostedChoice{"off", "M9"}};
inline constexpr std::array kCompensations{PostedChoice{"none", ""}, PostedChoice{"left", "G41"},
                                           PostedChoice{"right", "G42"},
                                           PostedChoice{"off", "G40"}};
inline constexpr std::array kStops{PostedChoice{"none", ""}, PostedChoice{"program", "M0"},
                                   PostedChoice{"optional", "M1"}};
/// To the clearances (G45 Z, G46 X) or to the tool change position (G47 Z, G48 X).
inline constexpr std::array kRetracts{PostedChoice{"none", ""},
                                      PostedChoice{"z clear", "G45"},
                                      PostedChoice{"x clear", "G46"},
                                      PostedChoice{"z-x clear", "G45 G46"},
                                      PostedChoice{"x-z clear", "G46 G45"},
                                      PostedChoice{"z home", "G47"},
                                      PostedChoice{"x home", "G48"},
                                      PostedChoice{"z-x home", "G47 G48"},
                                      PostedChoice{"x-z home", "G48 G47"}};
inline constexpr std::array kCuttingModes{
    PostedChoice{"none", ""}, PostedChoice{"exact stop", "G61"}, PostedChoice{"continuous", "G64"}};
inline constexpr std::array kProgramModes{PostedChoice{"none", ""}, PostedChoice{"absolute", "G93"},
                                          PostedChoice{"incremental", "G91"}};
inline constexpr std::array kWorkCoordinates{PostedChoice{"none", ""}, PostedChoice{"1", "G54"},
                                             PostedChoice{"2", "G55"}, PostedChoice{"3", "G56"},
                                             PostedChoice{"4", "G57"}, PostedChoice{"5", "G58"},
                                             PostedChoice{"6", "G59"}};
inline constexpr std::array kOptionalFunctions{PostedChoice{"none", ""},
                                               PostedChoice{"chuck in", "M21"},
                                               PostedChoice{"chuck out", "M22"},
                                               PostedChoice{"bar feed", "M23"},
                                               PostedChoice{"tailstock in", "M24"},
                                               PostedChoice{"tailstock out", "M25"},
                                               PostedChoice{"parts catcher in", "M26"},
                                               PostedChoice{"parts catcher out", "M27"},
                                               PostedChoice{"air blast on", "M28"},
                                               PostedChoice{"air blast off", "M29"},
                                               PostedChoice{"accessory 1", "M31"},
                                               PostedChoice{"accessory 2", "M32"},
                                               PostedChoice{"accessory 3", "M33"},
                                               PostedChoice{"accessory 4", "M34"},
                                               PostedChoice{"accessory 5", "M35"}};

template <std::size_t Size>
std::vector<std::string_view> names_of(const std::array<PostedChoice, Size>& choices) {
  std::vector<std::string_view> names;
  for (const auto& choice : choices) names.push_back(choice.name);
  return names;
}

template <std::size_t Size>
std::string_view posted(const std::array<PostedChoice, Size>& choices, std::size_t index) {
  return index < Size ? choices[index].posted : std::string_view();
}

}  // namespace dripline::conversational
