#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

/// The verbs and options of `dnc`. CLI11 parses them, in command_line.cpp alone: its headers add
/// four seconds to each file that includes them. Commands and options are handles; what they name
/// lives as long as the application.
namespace dripline::cli {

/// A rule for the text of an option; its words appear in the help.
class Check {
 public:
  /// `judge` gives the reason of a refusal, empty: none.
  Check(std::function<std::string(std::string&)> judge, const std::string& words);
  explicit Check(CLI::Validator validator);
  const CLI::Validator& validator() const { return *validator_; }

 private:
  std::shared_ptr<const CLI::Validator> validator_;
};

Check one_of(const std::vector<std::string>& words);
Check one_of_numbers(const std::vector<int>& numbers);
/// Both ends included.
template <class T>
Check in_range(T first, T last);
Check positive_number();
Check non_negative_number();

class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option required() const;
  /// What represents the value in the help.
  Option type_name(const std::string& name) const;
  Option check(const Check& check) const;
  Option excludes(const Option& other) const;
  Option needs(const Option& other) const;
  /// The heading of the help under which the option is listed.
  Option group(const std::string& heading) const;
  /// How many values follow it.
  Option expected(int min, int max) const;
  Option delimiter(char character) const;
  /// False: a second value needs the option again.
  Option allow_extra_args(bool allows) const;
  /// How often it was given. To be asked when a command runs.
  std::size_t count() const;

 private:
  CLI::Option* option_;
};

class Command {
 public:
  explicit Command(CLI::App* app) : app_(app) {}

  Command add_subcommand(const std::string& name, const std::string& help) const;
  /// `names`: "-o,--output" or "FILE". `value` is set when the line is parsed and lives until then.
  template <class T>
  Option add_option(const std::string& names, T& value, const std::string& help) const;
  Option add_flag(const std::string& names, bool& value, const std::string& help) const;
  Option add_flag_callback(const std::string& names, std::function<void()> action,
                           const std::string& help) const;
  Option get_option(const std::string& name) const;

  Command callback(std::function<void()> action) const;
  Command footer(const std::string& text) const;
  Command require_subcommand(int number) const;

 private:
  CLI::App* app_;
};

}  // namespace dripline::cli
