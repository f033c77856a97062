#include "clients/cli/completion.hpp"

#include <unistd.h>
#include <algorithm>
#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "gateway/interpreter/registry.hpp"

namespace dripline::cli {
namespace {

using Names = Candidates::Names;

constexpr unsigned kSeconds = 1;              ///< for the whole answer
constexpr std::uint64_t kMaxPrograms = 1000;  ///< more are no help in a shell

constexpr std::string_view kBash = R"(# bash: source <(dnc completion bash)
_dnc() {
  local IFS=$'\n'
  COMPREPLY=($(dnc completion words "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null))
  if [ "${COMPREPLY[0]}" = :files ]; then
    COMPREPLY=()
    compopt -o default
  fi
}
complete -F _dnc dnc
)";

constexpr std::string_view kZsh = R"(#compdef dnc
# zsh: dnc completion zsh > a folder of $fpath/_dnc
_dnc() {
  local -a candidates
  candidates=("${(@f)$(dnc completion words "${(@)words[2,CURRENT]}" 2>/dev/null)}")
  if [ "${candidates[1]}" = :files ]; then
    _files
  else
    compadd -- $candidates
  fi
}
compdef _dnc dnc
)";

constexpr std::string_view kFish =
    R"(# fish: dnc completion fish > ~/.config/fish/completions/dnc.fish
function __dnc_candidates
  set -l words (commandline -opc)
  set -l candidates (dnc completion words $words[2..-1] (commandline -ct) 2>/dev/null)
  if test "$candidates[1]" = :files
    __fish_complete_path (commandline -ct)
  else
    printf '%s\n' $candidates
  end
end
complete -c dnc -f -a '(__dnc_candidates)'
)";

/// What a value is called in the help says what it is. `group` decides what a NAME is one of.
Names names_of(std::string_view value, std::string_view group) {
  static const std::map<std::string_view, Names> kNames{
      {"FILE", Names::Files},       {"DIR", Names::Files},        {"IN", Names::Files},
      {"RECORDING", Names::Files},  {"PROGRAM", Names::Programs}, {"MACHINE", Names::Machines},
      {"RUN|MACHINE", Names::Runs}, {"PORT", Names::Ports},       {"RUN", Names::Runs},
      {"ID", Names::Runs},          {"CONTROL", Names::Controls}};
  static const std::map<std::string_view, Names> kGroups{
      {"program", Names::Programs}, {"machine", Names::Machines}, {"port", Names::Ports}};
  if (const auto found = kNames.find(value); found != kNames.end()) return found->second;
  const auto found = kGroups.find(group);
  return value == "NAME" && found != kGroups.end() ? found->second : Names::None;
}

/// "on|off" is a list of words; "N120" or "0..10" is not.
std::vector<std::string> fixed_words(const std::string& type) {
  if (type.find('|') == std::string::npos) return {};
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= type.size();) {
    const std::size_t end = std::min(type.find('|', at), type.size());
    words.push_back(type.substr(at, end - at));
    at = end + 1;
  }
  const bool are_words = std::ranges::all_of(words, [](const std::string& word) {
    return !word.empty() && std::ranges::none_of(word, [](char c) {
      return (c >= 'A' && c <= 'Z') || c == ' ' || c == '.';
    });
  });
  return are_words ? words : std::vector<std::string>();
}

Candidates values_of(const CLI::Option& option, std::string_view group) {
  Candidates candidates;
  candidates.words = fixed_words(option.get_type_name());
  if (!candidates.words.empty()) return candidates;
  std::string name = option.get_positional() ? option.get_name(true) : option.get_type_name();
  if (!option.get_positional() && names_of(name, group) == Names::None) {
    name = option.get_name();
    name.erase(0, name.find_first_not_of('-'));
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
    if (name == "STATE" || name == "SETUP" || name == "OUTPUT") name = "FILE";
  }
  candidates.names = names_of(name, group);
  return candidates;
}

/// Where the words before the last one lead.
struct Place {
  const CLI::App* verb;
  const CLI::Option* wants_value = nullptr;  ///< the word before the last is this option
  std::size_t positionals = 0;               ///< given already
};

const CLI::Option* option_of(const CLI::App& verb, const std::string& word) {
  for (const CLI::App* at = &verb; at != nullptr; at = at->get_parent()) {
    if (const auto* option = at->get_option_no_throw(word)) return option;
  }
  return nullptr;
}

const CLI::App* verb_of(const CLI::App& app, const std::string& word) {
  const auto verbs =
      app.get_subcommands([&](const CLI::App* verb) { return verb->get_name() == word; });
  return verbs.empty() ? nullptr : verbs.front();
}

Place place_of(const CLI::App& app, std::span<const std::string> words) {
  Place place{.verb = &app};
  for (const std::string& word : words) {
    if (std::exchange(place.wants_value, nullptr) != nullptr) continue;
    if (word.starts_with('-')) {
      const auto* option = option_of(*place.verb, word.substr(0, word.find('=')));
      const bool has_value = option != nullptr && option->get_items_expected_max() > 0;
      if (has_value && word.find('=') == std::string::npos) place.wants_value = option;
    } else if (const auto* verb = verb_of(*place.verb, word)) {
      place.verb = verb;
    } else {
      ++place.positionals;
    }
  }
  return place;
}

void append_verbs(const CLI::App& verb, std::vector<std::string>& words) {
  for (const auto* sub : verb.get_subcommands([](const CLI::App*) { return true; }))
    words.push_back(sub->get_name());
}

void append_options(const CLI::App& verb, std::vector<std::string>& words) {
  for (const CLI::App* at = &verb; at != nullptr; at = at->get_parent()) {
    for (const auto* option : at->get_options()) {
      for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
    }
  }
}

/// The positional in whose place the word is; the last one may take several.
const CLI::Option* positional_of(const CLI::App& verb, std::size_t number) {
  const CLI::Option* last = nullptr;
  for (const auto* option : verb.get_options()) {
    if (!option->get_positional()) continue;
    last = option;
    if (number-- == 0) return option;
  }
  return last != nullptr && last->get_items_expected_max() > 1 ? last : nullptr;
}

/// The options that say which server, from words that are not parsed.
void read_location(std::span<const std::string> words, client::LocationOptions& location) {
  const std::map<std::string_view, std::optional<std::string>*> options{
      {"--server", &location.server},    {"--token-file", &location.token_file},
      {"--ca", &location.ca_file},       {"--state", &location.state_dir},
      {"--cert", &location.certificate}, {"--key", &location.key}};
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const std::size_t end = words[i].find('=');
    const auto found = options.find(std::string_view(words[i]).substr(0, end));
    if (found == options.end()) continue;
    *found->second = end == std::string::npos ? words[i + 1] : words[i].substr(end + 1);
  }
}

/// A server that is away or refuses leaves nothing to offer.
std::vector<std::string> names_at(client::Client& client, Names names) {
  std::vector<std::string> found;
  const auto append = [&](const auto& reply, auto name) {
    if (!reply) return;
    for (const auto& item : *reply) found.push_back(item.*name);
  };
  if (names == Names::Programs) {
    const auto programs =
        fetch_all(kMaxPrograms, [&](client::Page page) { return client.programs(page); });
    append(programs, &client::Program::name);
  }
  if (names == Names::Machines) append(client.machines(), &client::Machine::name);
  if (names == Names::Ports) append(client.ports(), &client::Port::name);
  if (names == Names::Runs) {
    append(client.runs({.machine = {}, .program = {}, .state = {}, .page = {}}), &client::Run::id);
    found.insert(found.begin(), "latest");
  }
  return found;
}

std::vector<std::string> names_for(Names names, Context& context,
                                   std::span<const std::string> words) {
  std::vector<std::string> found;
  if (names == Names::Controls) {
    for (const auto& dialect : interpreter::dialects()) found.emplace_back(dialect.name);
  } else if (names != Names::None && names != Names::Files) {
    read_location(words, context.location);
    if (auto client = context.connect()) found = names_at(*client, names);
  }
  return found;
}

}  // namespace

Candidates candidates_of(const CLI::App& app, std::span<const std::string> words) {
  const std::string current = words.empty() ? "" : words.back();
  const Place place = place_of(app, words.empty() ? words : words.first(words.size() - 1));
  const CLI::App* group = place.verb->get_parent();
  const std::string group_name = group != nullptr ? group->get_name() : "";
  Candidates candidates;
  if (place.wants_value != nullptr) return values_of(*place.wants_value, group_name);
  if (current.starts_with('-')) {
    append_options(*place.verb, candidates.words);
    return candidates;
  }
  append_verbs(*place.verb, candidates.words);
  if (!candidates.words.empty()) return candidates;
  const auto* positional = positional_of(*place.verb, place.positionals);
  if (positional != nullptr) return values_of(*positional, group_name);
  append_options(*place.verb, candidates.words);
  return candidates;
}

int print_candidates(const CLI::App& app, Context& context, std::span<const std::string> words) {
  ::alarm(kSeconds);  // SIGALRM ends the process: the shell then offers nothing
  Candidates candidates = candidates_of(app, words);
  if (candidates.names == Names::Files) {
    context.print(":files\n");
    return kExitOk;
  }
  for (std::string& name : names_for(candidates.names, context, words))
    candidates.words.push_back(std::move(name));
  const std::string current = words.empty() ? "" : words.back();
  for (const std::string& word : candidates.words) {
    // Shells put names onto the terminal as they are.
    if (word.starts_with(current) && printable(word) == word) context.print(word + "\n");
  }
  return kExitOk;
}

void add_completion_command(Command app, Context& context) {
  auto shell = std::make_shared<std::string>();
  auto verb = app.add_subcommand("completion", "Print the script that completes dnc in a shell");
  verb.add_option("SHELL", *shell, "The shell").required().check(one_of({"bash", "zsh", "fish"}));
  verb.callback([&context, shell] {
    context.print(*shell == "bash" ? kBash : *shell == "zsh" ? kZsh : kFish);
  });
}

}  // namespace dripline::cli
