#include <filesystem>
#include <map>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/mapped_file.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"
#include "protocol/archive/archive_entry.hpp"
#include "protocol/audit/trail_file.hpp"

namespace dripline::cli {
namespace {

struct AuditCommand {
  std::string file, checkpoint, archives, output;
};

/// The archives that an exported trail has entries of, by file.
using Archives = std::map<std::string, Digest>;

Result<audit::TrailReader> reader_for(const AuditCommand& command) {
  if (command.checkpoint.empty()) return audit::TrailReader();
  const auto file = MappedFile::open(command.checkpoint);
  if (!file) return fail(file.error());
  auto kept = audit::parse_kept_checkpoint(file->text());
  if (!kept) return fail(kept.error().code, "{}: {}", command.checkpoint, kept.error().what);
  return audit::TrailReader(*std::move(kept));
}

int print_fault(const audit::Fault& fault) {
  complain(Error{Errc::Corrupt, fmt::format("the audit trail was changed: {}", fault.what)});
  return kExitNo;
}

/// The first fault goes before what else is wrong with the file.
int print_trail(Context& context, audit::TrailReader& reader, const Result<void>& read) {
  const auto over = read ? reader.finish() : read;
  const auto& verifier = reader.verifier();
  if (verifier && verifier->first_fault()) return print_fault(*verifier->first_fault());
  if (!over) {
    complain(over.error());
    return kExitNo;  // cut off, or not of the kept checkpoint: changed too
  }
  const auto& checkpoint = verifier->checkpoint();
  context.print(fmt::format(
      "{} entries, each as it was written. Signed up to entry {} with the key\n{}\n",
      verifier->entries(), checkpoint ? checkpoint->entry : 0, reader.header()->key.hex()));
  return kExitOk;
}

/// The files of a folder against the trail's digests, without a server.
int verify_archives(Context& context, const std::filesystem::path& folder,
                    const Archives& archives) {
  int status = kExitOk;
  for (const auto& [name, sha256] : archives) {
    const auto is = archive::digest_of(folder / std::filesystem::path(name).filename());
    if (is && *is == sha256) continue;
    const std::string what =
        is ? fmt::format("it was changed: its SHA-256 is {}, the audit trail has {}", is->hex(),
                         sha256.hex())
           : is.error().what;
    complain(Error{Errc::Corrupt, fmt::format("archive {}: {}", printable(name), what)});
    status = kExitNo;
  }
  if (status == kExitOk)
    context.print(fmt::format("{} archives, each as it was written.\n", archives.size()));
  return status;
}

int verify_file(Context& context, const AuditCommand& command) {
  auto reader = reader_for(command);
  if (!reader) return complain(reader.error());
  const auto file = MappedFile::open(command.file);
  if (!file) return complain(file.error());
  Archives archives;
  reader->on_entry = [&archives](const audit::Entry& entry) {
    if (entry.action != archive::kMadeAction) return;
    if (const auto sha256 = archive::digest_in(entry.detail)) archives[entry.subject] = *sha256;
  };
  const int status = print_trail(context, *reader, reader->feed(file->text()));
  if (status != kExitOk || command.archives.empty()) return status;
  return verify_archives(context, command.archives, archives);
}

/// Here, so that it does not depend on what the server makes of its own trail.
int verify_exported(Context& context, client::Client& client, const AuditCommand& command) {
  auto reader = reader_for(command);
  if (!reader) return complain(reader.error());
  Result<void> read;
  const auto got = client.export_audit([&](std::string_view bytes) {
    read = reader->feed(bytes);
    return read.has_value();
  });
  if (!got && read) return complain(got.error());
  return print_trail(context, *reader, read);
}

/// Of the trail, then of each archive.
int print_faults(const client::AuditState& state) {
  if (state.verification && state.verification->fault) {
    print_fault({state.verification->fault->entry, printable(state.verification->fault->what)});
  }
  if (!state.archives) return kExitNo;
  for (const auto& fault : state.archives->faults) {
    complain(Error{Errc::Corrupt,
                   fmt::format("archive {}: {}", printable(fault.file), printable(fault.what))});
  }
  return kExitNo;
}

int verify_at_server(Context& context, client::Client& client) {
  const auto state = client.verify_audit();
  if (!state) return complain(state.error());
  const auto& verification = state->verification;
  const bool is_whole =
      !(verification && verification->fault) && (!state->archives || state->archives->intact);
  if (context.wants_json) {
    context.print(json_text(*state));
    return is_whole ? kExitOk : kExitNo;
  }
  if (!is_whole) return print_faults(*state);
  context.print(fmt::format("{} entries and the runs that ended, each as it was written.",
                            verification ? verification->entries : 0));
  if (state->checkpoint) {
    context.print(fmt::format(" Checkpoint {}: entry {}, {}", state->checkpoint->number,
                              state->checkpoint->entry, time_text(state->checkpoint->time)));
  }
  context.print("\n");
  if (const auto& archives = state->archives) {
    context.print(fmt::format("{} archives, each as it was written.\n", archives->archives));
  }
  return kExitOk;
}

void verify(Context& context, const AuditCommand& command) {
  if (!command.archives.empty() && command.file.empty()) {
    complain(Error{Errc::Syntax,
                   "--archives needs an exported trail: FILE; the server checks its own archives"});
    context.status = kExitUsage;
    return;
  }
  if (!command.file.empty()) {
    context.status = verify_file(context, command);
    return;
  }
  auto client = context.connect();
  if (!client) return;
  context.status = command.checkpoint.empty() ? verify_at_server(context, *client)
                                              : verify_exported(context, *client, command);
}

int export_trail(Context&, client::Client& client, const AuditCommand& command) {
  return save_content(command.output,
                      [&](const ContentSink& sink) { return client.export_audit(sink); });
}

int print_checkpoint(Context& context, client::Client& client) {
  const auto state = client.verify_audit();
  if (!state) return complain(state.error());
  if (state->verification && state->verification->fault) {
    return print_fault(
        {state->verification->fault->entry, printable(state->verification->fault->what)});
  }
  if (!state->checkpoint) return complain({Errc::NotFound, "the audit trail has no entry yet"});
  context.print(state->checkpoint->text);
  return kExitOk;
}

void add_verify(Command group, Context& context) {
  auto command = group.add_subcommand("verify", "Verify that the audit trail is as it was written");
  auto options = std::make_shared<AuditCommand>();
  command.add_option("FILE", options->file, "An exported trail; needs no server");
  command.add_option("--checkpoint", options->checkpoint,
                     "A checkpoint that was kept elsewhere, from dnc audit checkpoint");
  command.add_option("--archives", options->archives,
                     "Folder of archives: compare each that FILE has an entry of");
  add_json_flag(command, context);
  command.footer(
      "Names the first place that was changed, removed or inserted. Without FILE and --checkpoint "
      "the server\nverifies its own trail, compares the runs that ended with their entries, and "
      "reads "
      "the archives\nthat the trail names. "
      "Only a checkpoint that was\nkept elsewhere shows that the end was cut off, or that someone "
      "who has the server's key wrote\nanother trail.\n\nExample:\n  dnc audit verify trail.txt "
      "--checkpoint monday.txt");
  command.callback([&context, options] { verify(context, *options); });
}

}  // namespace

void add_audit_commands(Command app, Context& context) {
  auto group = app.add_subcommand("audit", "The audit trail: who did what");
  group.require_subcommand(1);
  add_verify(group, context);

  auto exported = group.add_subcommand("export", "Write the whole trail to a file");
  auto options = std::make_shared<AuditCommand>();
  exported.add_option("FILE", options->output, "File to write").required();
  run_at_server(exported, context, options, export_trail);

  auto checkpoint =
      group.add_subcommand("checkpoint", "Print a signed checkpoint to keep elsewhere");
  checkpoint.footer(
      "The server verifies its trail and signs where it is.\n\nExample:\n  dnc audit checkpoint > "
      "monday.txt");
  run_at_server(checkpoint, context, print_checkpoint);
}

}  // namespace dripline::cli
