#include "clients/cli/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

namespace dripline::cli {
namespace {

/// The validator's name is what represents the value in the help, in the place of its description.
Check named(CLI::Validator validator, const std::string& words) {
  return Check(std::move(validator.name(words).description("")));
}

}  // namespace

Check::Check(std::function<std::string(std::string&)> judge, const std::string& words)
    : Check(CLI::Validator(std::move(judge), words)) {}

Check::Check(CLI::Validator validator)
    : validator_(std::make_shared<const CLI::Validator>(std::move(validator))) {}

Check one_of(const std::vector<std::string>& words) {
  return named(CLI::IsMember(words), fmt::format("{}", fmt::join(words, "|")));
}

Check one_of_numbers(const std::vector<int>& numbers) {
  return named(CLI::IsMember(numbers), fmt::format("{}", fmt::join(numbers, "|")));
}

template <class T>
Check in_range(T first, T last) {
  return named(CLI::Range(first, last), fmt::format("{}..{}", first, last));
}

template Check in_range(int, int);
template Check in_range(unsigned, unsigned);
template Check in_range(double, double);

Check positive_number() {
  return named(CLI::PositiveNumber, "NUMBER>0");
}

Check non_negative_number() {
  return named(CLI::NonNegativeNumber, "NUMBER>=0");
}

Option Option::required() const {
  return Option(option_->required());
}

Option Option::type_name(const std::string& name) const {
  return Option(option_->type_name(name));
}

Option Option::check(const Check& check) const {
  if (const std::string& words = check.validator().get_name(); !words.empty())
    option_->type_name(words);
  return Option(option_->check(check.validator()));
}

Option Option::excludes(const Option& other) const {
  return Option(option_->excludes(other.option_));
}

Option Option::needs(const Option& other) const {
  return Option(option_->needs(other.option_));
}

Option Option::group(const std::string& heading) const {
  return Option(option_->group(heading));
}

Option Option::expected(int min, int max) const {
  return Option(option_->expected(min, max));
}

Option Option::delimiter(char character) const {
  return Option(option_->delimiter(character));
}

Option Option::allow_extra_args(bool allows) const {
  return Option(option_->allow_extra_args(allows));
}

std::size_t Option::count() const {
  return option_->count();
}

Command Command::add_subcommand(const std::string& name, const std::string& help) const {
  return Command(app_->add_subcommand(name, help));
}

namespace {

template <class T>
constexpr bool kIsUnsigned = std::is_unsigned_v<T>;
template <class T>
constexpr bool kIsUnsigned<std::optional<T>> = std::is_unsigned_v<T>;

/// CLI11 takes -1 for the largest number.
std::string refuse_negative(const std::string& text) {
  return text.starts_with('-') ? fmt::format("{} is below 0", text) : std::string();
}

}  // namespace

template <class T>
Option Command::add_option(const std::string& names, T& value, const std::string& help) const {
  CLI::Option* option = app_->add_option(names, value, help);
  if constexpr (kIsUnsigned<T>) option->check(refuse_negative, "");
  return Option(option);
}

// Every type that a command takes.
template Option Command::add_option(const std::string&, std::string&, const std::string&) const;
template Option Command::add_option(const std::string&, int&, const std::string&) const;
template Option Command::add_option(const std::string&, unsigned&, const std::string&) const;
template Option Command::add_option(const std::string&, std::uint64_t&, const std::string&) const;
template Option Command::add_option(const std::string&, double&, const std::string&) const;
template Option Command::add_option(const std::string&, std::optional<std::string>&,
                                    const std::string&) const;
template Option Command::add_option(const std::string&, std::optional<int>&,
                                    const std::string&) const;
template Option Command::add_option(const std::string&, std::optional<unsigned>&,
                                    const std::string&) const;
template Option Command::add_option(const std::string&, std::optional<std::uint64_t>&,
                                    const std::string&) const;
template Option Command::add_option(const std::string&, std::optional<double>&,
                                    const std::string&) const;
template Option Command::add_option(const std::string&, std::vector<std::string>&,
                                    const std::string&) const;
template Option Command::add_option(const std::string&, std::vector<double>&,
                                    const std::string&) const;
template Option Command::add_option(const std::string&,
                                    std::vector<std::pair<std::string, std::string>>&,
                                    const std::string&) const;

Option Command::add_flag(const std::string& names, bool& value, const std::string& help) const {
  return Option(app_->add_flag(names, value, help));
}

Option Command::add_flag_callback(const std::string& names, std::function<void()> action,
                                  const std::string& help) const {
  return Option(app_->add_flag_callback(names, std::move(action), help));
}

Option Command::get_option(const std::string& name) const {
  return Option(app_->get_option(name));
}

Command Command::callback(std::function<void()> action) const {
  return Command(app_->callback(std::move(action)));
}

Command Command::footer(const std::string& text) const {
  return Command(app_->footer(text));
}

Command Command::require_subcommand(int number) const {
  return Command(app_->require_subcommand(number));
}

}  // namespace dripline::cli
