#include "clients/cli/server/programs/program_transfer.hpp"

#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "clients/cli/context.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/progress.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/lib/pull.hpp"
#include "clients/lib/push.hpp"
#include "protocol/base/names.hpp"

namespace dripline::cli {
namespace {

/// A revision in one line.
std::string revision_line(const char* verb, const client::Revision& revision, double seconds) {
  const auto rate = seconds > 0.05 ? static_cast<double>(revision.size) / seconds : 0;
  std::string line =
      fmt::format("{} {} revision {}: {}, sha256 {}", verb, revision.program, revision.revision,
                  bytes_text(revision.size), short_id(revision.sha256));
  if (rate > 0) line += fmt::format(", {}/s", bytes_text(static_cast<std::uint64_t>(rate)));
  return line + "\n";
}

double seconds_since(SteadyTime begun, const Clock& clock) {
  return std::chrono::duration<double>(clock.steady_now() - begun).count();
}

int ended(const client::Failure& failure, const char* what) {
  if (!is_interrupted()) return complain(failure);
  print_error("dnc: {} was ended; nothing was changed\n", what);
  return kExitInterrupted;
}

}  // namespace

int push(Context& context, const PushCommand& command) {
  const std::string name =
      command.name.empty() ? std::filesystem::path(command.file).filename().string() : command.name;
  if (auto named = check_program_name(name); !named) return complain(named.error());
  auto source = client::FileSource::open(command.file);
  if (!source) return complain(source.error());
  auto client = context.connect();
  if (!client) return context.status;
  catch_interrupts();
  SystemClock clock;
  LiveArea area = LiveArea::on_stderr();
  client::PushOptions options{
      {name, command.control, command.comment, command.overrides_protection, command.fields},
      retry_policy(),
      {}};
  const SteadyTime begun = clock.steady_now();
  const auto pushed = [&] {
    Progress progress(area, clock, name);
    options.on_progress = [&](std::uint64_t done, std::uint64_t total) {
      progress.update(done, total);
      return !is_interrupted();
    };
    return push_program(*client, *source, options);
  }();
  if (!pushed) return ended(pushed.error(), "the push");
  if (context.wants_json) {
    context.print(json_text(*pushed));
  } else if (pushed->unchanged) {
    context.print(fmt::format("{} is unchanged: revision {} already has this content\n", name,
                              pushed->revision));
  } else {
    context.print(revision_line("Pushed", *pushed, seconds_since(begun, clock)));
  }
  return kExitOk;
}

int pull(Context& context, const PullCommand& command) {
  auto client = context.connect();
  if (!client) return context.status;
  catch_interrupts();
  SystemClock clock;
  LiveArea area = LiveArea::on_stderr();
  client::PullOptions options{command.name, command.revision, retry_policy(), {}};
  StandardOutput output;
  const bool to_stdout = command.output == "-";
  const std::string path = command.output.empty() ? command.name : command.output;
  const SteadyTime begun = clock.steady_now();
  const auto pulled = [&] {
    Progress progress(area, clock, command.name);
    options.on_progress = [&](std::uint64_t done, std::uint64_t total) {
      progress.update(done, total);
      return !is_interrupted();
    };
    return to_stdout
               ? pull_program(*client, options,
                              [&output](std::string_view bytes) { return output.write(bytes); })
               : pull_program_to_file(*client, options, path);
  }();
  if (output.error()) return output.complain();
  if (!pulled) return ended(pulled.error(), "the pull");
  if (!to_stdout) {
    const std::string line = revision_line("Pulled", *pulled, seconds_since(begun, clock));
    context.print(line.substr(0, line.size() - 1) + " -> " + path + "\n");
  }
  return kExitOk;
}

}  // namespace dripline::cli
