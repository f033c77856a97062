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

inline constexpr auto kFeedModes =
    std::to_array<PostedChoice>({{"none", ""}, {"revolution", "G99"}, {"minute", "G98"}});
inline constexpr auto kSpindleModes =
    std::to_array<PostedChoice>({{"none", ""}, {"surface speed", "G96"}, {"rpm", "G97"}});
inline constexpr auto kGears =
    std::to_array<PostedChoice>({{"none", ""}, {"low", "M41"}, {"medium", "M42"}, {"high", "M43"}});
inline constexpr auto kSpindles =
    std::to_array<PostedChoice>({{"none", ""}, {"cw", "M3"}, {"ccw", "M4"}, {"off", "M5"}});
inline constexpr auto kCoolants =
    std::to_array<PostedChoice>({{"none", ""}, {"on", "M8"}, {"off", "M9"}});
inline constexpr auto kCompensations =
    std::to_array<PostedChoice>({{"none", ""}, {"left", "G41"}, {"right", "G42"}, {"off", "G40"}});
inline constexpr auto kStops =
    std::to_array<PostedChoice>({{"none", ""}, {"program", "M0"}, {"optional", "M1"}});
/// To the clearances (G45 Z, G46 X) or to the tool change position (G47 Z, G48 X).
inline constexpr auto kRetracts = std::to_array<PostedChoice>({{"none", ""},
                                                               {"z clear", "G45"},
                                                               {"x clear", "G46"},
                                                               {"z-x clear", "G45 G46"},
                                                               {"x-z clear", "G46 G45"},
                                                               {"z home", "G47"},
                                                               {"x home", "G48"},
                                                               {"z-x home", "G47 G48"},
                                                               {"x-z home", "G48 G47"}});
inline constexpr auto kCuttingModes =
    std::to_array<PostedChoice>({{"none", ""}, {"exact stop", "G61"}, {"continuous", "G64"}});
inline constexpr auto kProgramModes =
    std::to_array<PostedChoice>({{"none", ""}, {"absolute", "G93"}, {"incremental", "G91"}});
inline constexpr auto kWorkCoordinates = std::to_array<PostedChoice>({{"none", ""},
                                                                      {"1", "G54"},
                                                                      {"2", "G55"},
                                                                      {"3", "G56"},
                                                                      {"4", "G57"},
                                                                      {"5", "G58"},
                                                                      {"6", "G59"}});
inline constexpr auto kOptionalFunctions =
    std::to_array<PostedChoice>({{"none", ""},
                                 {"chuck in", "M21"},
                                 {"chuck out", "M22"},
                                 {"bar feed", "M23"},
                                 {"tailstock in", "M24"},
                                 {"tailstock out", "M25"},
                                 {"parts catcher in", "M26"},
                                 {"parts catcher out", "M27"},
                                 {"air blast on", "M28"},
                                 {"air blast off", "M29"},
                                 {"accessory 1", "M31"},
                                 {"accessory 2", "M32"},
                                 {"accessory 3", "M33"},
                                 {"accessory 4", "M34"},
                                 {"accessory 5", "M35"}});

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
