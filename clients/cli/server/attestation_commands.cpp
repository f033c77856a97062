#include "clients/cli/server/attestation_commands.hpp"

#include <memory>

#include "clients/cli/offline/mapped_file.hpp"
#include "clients/cli/server/runs/run_control.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"
#include "protocol/audit/attestation.hpp"
#include "protocol/audit/trail_file.hpp"
#include "protocol/base/digest.hpp"

namespace dripline::cli {
namespace {

struct AttestationCommand {
  std::string run, output, file, program, checkpoint;
};

int write_attestation(Context& context, client::Client& client, const AttestationCommand& command) {
  const auto run = find_run(client, command.run);
  if (!run) return complain(run.error());
  std::string text;
  const auto got = client.run_attestation(run->id, [&](std::string_view bytes) {
    text += bytes;
    return text.size() <= audit::kMaxAttestation;
  });
  if (!got) return complain(got.error());
  if (command.output.empty() || command.output == "-") {
    context.print_content(text);
    return kExitOk;
  }
  return save_content(command.output, [&](const ContentSink& sink) {
    sink(text);
    return client::Reply<void>{};
  });
}

int disprove(const std::string& why) {
  complain(Error{Errc::Corrupt, why});
  return kExitNo;
}

/// The decision that released the program, by the same server.
Result<void> check_approval(const audit::Attestation& attestation) {
  const auto hex = attestation.value("approval_signature");
  if (hex.empty()) return {};
  const auto signature = parse_signature(hex);
  if (!signature) return fail(signature.error());
  if (is_signed_by(attestation.key, attestation.value("approval_text"), *signature)) return {};
  return fail(Errc::Corrupt, "the approval is not signed by this server");
}

Result<void> check_program(const audit::Attestation& attestation, const std::string& path) {
  if (path.empty()) return {};
  const auto file = MappedFile::open(path);
  if (!file) return fail(file.error());
  const std::string found = sha256(file->text()).hex();
  if (attestation.value("sha256") == found) return {};
  return fail(Errc::Corrupt, "{} is not the program that was run: its sha256 is {}, the run's {}",
              path, found, attestation.value("sha256"));
}

Result<void> check_key(const audit::Attestation& attestation, const std::string& path) {
  if (path.empty()) return {};
  const auto file = MappedFile::open(path);
  if (!file) return fail(file.error());
  const auto kept = audit::parse_kept_checkpoint(file->text());
  if (!kept) return fail(kept.error().code, "{}: {}", path, kept.error().what);
  if (kept->header.key == attestation.key) return {};
  return fail(Errc::Corrupt, "it is signed with the key {}, the server of {} has {}",
              attestation.key.hex(), path, kept->header.key.hex());
}

void verify(Context& context, const AttestationCommand& command) {
  const auto file = MappedFile::open(command.file);
  if (!file) {
    context.status = complain(file.error());
    return;
  }
  const auto attestation = audit::parse_attestation(file->text());
  if (!attestation) {
    context.status = disprove(attestation.error().what);
    return;
  }
  for (const auto& checked :
       {check_key(*attestation, command.checkpoint), check_approval(*attestation),
        check_program(*attestation, command.program)}) {
    if (checked) continue;
    context.status = disprove(checked.error().what);
    return;
  }
  Details details;
  for (const auto& fact : attestation->facts) {
    if (!fact.value.empty() && fact.name != "approval_text" && fact.name != "approval_signature")
      details.add(fact.name, printable(fact.value));
  }
  details.add("signed by", attestation->key.hex());
  context.print(details);
}

}  // namespace

void add_attestation_commands(Command group, Context& context) {
  auto options = std::make_shared<AttestationCommand>();
  auto made = group.add_subcommand("attestation", "Print what the server attests of a run");
  made.add_option("ID", options->run, kRunHelp).required();
  made.add_option("-o,--output", options->output,
                  "File to write, - for standard output (default: -)");
  made.footer(
      "Program, setup, machine, approval, outcome and what was executed, signed by the server, and "
      "where the\nend of the run is in its audit trail.\n\nExample:\n  dnc run attestation latest "
      "-o shaft.txt");
  run_at_server(made, context, options, write_attestation);

  auto checked = std::make_shared<AttestationCommand>();
  auto verified = group.add_subcommand("verify", "Verify an attestation; needs no server");
  verified.add_option("FILE", checked->file, "From dnc run attestation").required();
  verified.add_option("--program", checked->program, "The program's file: compare its bytes too");
  verified.add_option("--checkpoint", checked->checkpoint,
                      "From dnc audit checkpoint: demand the key of that server");
  verified.footer("Exit status: 0 nothing was changed, 1 something was.");
  verified.callback([&context, checked] { verify(context, *checked); });
}

}  // namespace dripline::cli
