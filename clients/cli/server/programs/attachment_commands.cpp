#include <filesystem>
#include <memory>

#include "clients/cli/server/programs/library_commands.hpp"
#include "clients/cli/text/named_revision.hpp"
#include "clients/cli/text/progress.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/lib/pull.hpp"
#include "clients/lib/push.hpp"

namespace dripline::cli {
namespace {

struct AttachmentCommand {
  std::string program, name;
  std::vector<std::string> files;
  std::string comment, output;
  bool overwrites = false;
};

std::string owner_text(const client::Attachment& attachment) {
  return attachment.revision ? fmt::format("revision {}", *attachment.revision) : "program";
}

int attach_file(Context& context, client::Client& client, const AttachmentCommand& command,
                const std::string& file) {
  const NamedRevision owner = named_revision(command.program);
  auto source = client::FileSource::open(file);
  if (!source) return complain(source.error());
  const std::string name =
      command.name.empty() ? std::filesystem::path(file).filename().string() : command.name;
  SystemClock clock;
  LiveArea area = LiveArea::on_stderr();
  Progress progress(area, clock, name);
  client::AttachOptions options{{owner.program, owner.revision, name, command.comment},
                                retry_policy(),
                                [&](std::uint64_t done, std::uint64_t total) {
                                  progress.update(done, total);
                                  return !is_interrupted();
                                }};
  const auto attached = client::push_attachment(client, *source, options);
  if (!attached) return is_interrupted() ? kExitInterrupted : complain(attached.error());
  context.print(context.wants_json
                    ? json_text(*attached)
                    : fmt::format("Attached {} to {} of {}: {}, sha256 {}\n",
                                  printable(attached->name), owner_text(*attached),
                                  printable(attached->program), bytes_text(attached->size),
                                  short_id(attached->sha256)));
  return kExitOk;
}

int attach(Context& context, client::Client& client, const AttachmentCommand& command) {
  if (!command.name.empty() && command.files.size() > 1)
    return complain(Error{Errc::Syntax, "--name is for one file"});
  catch_interrupts();
  for (const auto& file : command.files) {
    if (const int status = attach_file(context, client, command, file); status != kExitOk)
      return status;
  }
  return kExitOk;
}

int list_attachments(Context& context, client::Client& client, const AttachmentCommand& command) {
  const NamedRevision owner = named_revision(command.program);
  auto attachments = client.attachments(owner.program, owner.revision);
  if (const auto status = finished(context, attachments, "attachments")) return *status;
  Table table({"NAME", "OF", right("SIZE"), "SHA-256", "CREATED", "AUTHOR", "COMMENT"});
  for (const auto& attachment : *attachments) {
    table.add({printable(attachment.name), owner_text(attachment), bytes_text(attachment.size),
               short_id(attachment.sha256), time_text(attachment.created),
               printable(attachment.author), printable(attachment.comment)});
  }
  if (table.empty()) context.print("There is none; dnc program attach adds one.\n");
  if (!table.empty()) context.print(table);
  return kExitOk;
}

/// The one that is meant: of the revision, or else of the program.
client::Reply<client::Attachment> find_attachment(client::Client& client,
                                                  const AttachmentCommand& command) {
  const NamedRevision owner = named_revision(command.program);
  auto attachments = client.attachments(owner.program, owner.revision);
  if (!attachments) return client::failed(attachments.error());
  const client::Attachment* found = nullptr;
  for (const auto& attachment : *attachments) {
    const bool is_of_it = attachment.revision == owner.revision || !attachment.revision;
    if (attachment.name == command.name && is_of_it) found = &attachment;
  }
  if (found != nullptr) return *found;
  return client::failed(client::Failure::Kind::Refused, Errc::NotFound,
                        "program {} has no attachment '{}'", command.program, command.name);
}

/// The name came from the server: it may lead nowhere but into this folder.
Result<std::string> output_of(const AttachmentCommand& command) {
  if (!command.output.empty()) return command.output;
  const std::filesystem::path name = command.name;
  const bool is_plain = name.filename() == name && printable(command.name) == command.name &&
                        !command.name.starts_with('.');
  if (!is_plain)
    return fail(Errc::Syntax, "'{}' is no file name here: use -o FILE", printable(command.name));
  return command.name;
}

int download(Context& context, client::Client& client, const AttachmentCommand& command) {
  const auto path = output_of(command);
  if (!path) return complain(path.error());
  if (!command.overwrites && std::filesystem::exists(*path))
    return complain(Error{Errc::Conflict, fmt::format("{} exists: --force replaces it", *path)});
  const auto attachment = find_attachment(client, command);
  if (!attachment) return complain(attachment.error());
  catch_interrupts();
  SystemClock clock;
  LiveArea area = LiveArea::on_stderr();
  const auto pulled = [&] {
    Progress progress(area, clock, command.name);
    return client::pull_attachment_to_file(
        client, *attachment, {*path, retry_policy(), [&](std::uint64_t done, std::uint64_t total) {
                                progress.update(done, total);
                                return !is_interrupted();
                              }});
  }();
  if (!pulled) return is_interrupted() ? kExitInterrupted : complain(pulled.error());
  context.print(fmt::format("{}: {}, sha256 {}\n", *path, bytes_text(attachment->size),
                            short_id(attachment->sha256)));
  return kExitOk;
}

int detach(Context& context, client::Client& client, const AttachmentCommand& command) {
  const NamedRevision owner = named_revision(command.program);
  const auto removed = client.remove_attachment({owner.program, owner.revision, command.name, {}});
  if (!removed) return complain(removed.error());
  context.print(
      fmt::format("Detached {} from {}.\n", printable(command.name), printable(command.program)));
  return kExitOk;
}

Command add_attachment_verb(Command group, const char* name, const char* help,
                            const std::shared_ptr<AttachmentCommand>& options) {
  auto command = group.add_subcommand(name, help);
  command.add_option("PROGRAM", options->program, "NAME, or NAME@REVISION for one revision")
      .required();
  return command;
}

}  // namespace

void add_attachment_commands(Command group, Context& context) {
  auto options = std::make_shared<AttachmentCommand>();
  auto command = add_attachment_verb(group, "attach",
                                     "Attach setup sheets, drawings ... to a program", options);
  command.add_option("FILE", options->files, "What to attach").required();
  command.add_option("--name", options->name, "Its name there (default: FILE's name)");
  command.add_option("--comment", options->comment, "Kept with it");
  add_json_flag(command, context);
  command.footer(
      "Files of any kind, up to 256 MiB, sent and kept as programs are (SHA-256). One of the same "
      "name with other\nbytes is refused.\n\nExample:\n  dnc program attach O0200@3 setup.pdf");
  run_at_server(command, context, options, attach);

  options = std::make_shared<AttachmentCommand>();
  command =
      add_attachment_verb(group, "attachments", "List what is attached to a program", options);
  add_json_flag(command, context);
  run_at_server(command, context, options, list_attachments);

  options = std::make_shared<AttachmentCommand>();
  command = add_attachment_verb(group, "download", "Fetch an attachment", options);
  command.add_option("ATTACHMENT", options->name, "Its name").required();
  command.add_option("-o,--output", options->output, "File to write (default: ATTACHMENT here)");
  command.add_flag("--force", options->overwrites, "Replace a file that exists");
  run_at_server(command, context, options, download);

  options = std::make_shared<AttachmentCommand>();
  command = add_attachment_verb(group, "detach", "Remove an attachment", options);
  command.add_option("ATTACHMENT", options->name, "Its name").required();
  run_at_server(command, context, options, detach);
}

}  // namespace dripline::cli
