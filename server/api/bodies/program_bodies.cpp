#include "server/api/bodies/program_bodies.hpp"

#include "protocol/base/names.hpp"
#include "server/api/bodies/json_object.hpp"
#include "server/api/request.hpp"
#include "server/library/releases.hpp"

namespace dripline::api {
namespace {

storage::FieldChange take_fields(JsonObject& object) {
  const auto field = [&](const char* name) {
    return object.optional_text(name, storage::kMaxField);
  };
  return {.part = field("part"),
          .operation = field("operation"),
          .material = field("material"),
          .machine_group = field("machine_group"),
          .cam_file = field("cam_file")};
}

}  // namespace

Result<library::ClosureRequest::Named> parse_named_program(const std::string& text) {
  const auto at = text.find('@');
  library::ClosureRequest::Named named{.program = text.substr(0, at), .revision = {}};
  if (auto good = check_program_name(named.program); !good) return fail(good.error());
  if (at == std::string::npos) return named;
  const auto number = parse_unsigned(text.substr(at + 1));
  if (!number) return fail(Errc::Syntax, "'{}': expected a program, or PROGRAM@REVISION", text);
  named.revision = *number;
  return named;
}

Result<library::UploadRequest> decode_upload(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  library::UploadRequest upload;
  upload.program = object->required_text("program", kMaxName);
  upload.control = object->optional_text("control", kMaxName).value_or("");
  upload.comment = object->optional_text("comment", library::Programs::kMaxComment).value_or("");
  upload.change = take_fields(*object);
  if (auto good = object->finish(); !good) return fail(good.error());
  if (auto good = check_program_name(upload.program); !good) return fail(good.error());
  if (auto good = library::check_fields(upload.change); !good) return fail(good.error());
  return upload;
}

Result<storage::Description> decode_description(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  storage::Description description;
  description.revision = object->optional_unsigned("revision");
  description.change = take_fields(*object);
  if (auto good = object->finish(); !good) return fail(good.error());
  if (auto good = library::check_fields(description.change); !good) return fail(good.error());
  if (!description.change.is_empty()) return description;
  return fail(Errc::Syntax,
              "expected at least one of part, operation, material, machine_group and cam_file");
}

Result<library::Attachments::Request> decode_attachment(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  library::Attachments::Request attachment;
  attachment.name.name = object->required_text("name", library::Attachments::kMaxName);
  attachment.name.revision = object->optional_unsigned("revision");
  attachment.comment =
      object->optional_text("comment", library::Programs::kMaxComment).value_or("");
  if (auto good = object->finish(); !good) return fail(good.error());
  if (auto good = library::check_attachment_name(attachment.name.name); !good)
    return fail(good.error());
  return attachment;
}

Result<CommitBody> decode_commit(std::string_view body) {
  if (body.empty()) return CommitBody{};
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  const auto text = object->optional_text("sha256", kMaxName);
  CommitBody commit;
  commit.force = object->optional_flag("force").value_or(false);
  if (auto good = object->finish(); !good) return fail(good.error());
  if (!text) return commit;
  const auto digest = parse_digest(*text);
  if (!digest) return fail(Errc::Syntax, "member 'sha256': {}", digest.error().what);
  commit.sha256 = *digest;
  return commit;
}

Result<CopyBody> decode_copy(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  CopyBody copy;
  copy.to = object->required_text("to", kMaxName);
  copy.revision = object->optional_unsigned("revision");
  if (auto good = object->finish(); !good) return fail(good.error());
  if (auto good = check_program_name(copy.to); !good) return fail(good.error());
  return copy;
}

Result<std::string> decode_decision(std::string_view body) {
  if (body.empty()) return std::string();
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  auto comment = object->optional_text("comment", library::Releases::kMaxComment).value_or("");
  if (auto good = object->finish(); !good) return fail(good.error());
  return comment;
}

Result<ReleaseBody> decode_release(std::string_view body) {
  if (body.empty()) return ReleaseBody{};
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  ReleaseBody release;
  release.comment = object->optional_text("comment", library::Releases::kMaxComment).value_or("");
  release.has_closure = object->optional_flag("closure").value_or(false);
  release.machine = object->optional_text("machine", kMaxName).value_or("");
  const auto named = object->optional_texts("with", kMaxName, storage::Decision::kMaxPins);
  if (auto good = object->finish(); !good) return fail(good.error());
  if (!release.has_closure && (!named.empty() || !release.machine.empty()))
    return fail(Errc::Syntax, "members 'with' and 'machine' are for a release with 'closure'");
  for (const auto& text : named) {
    auto program = parse_named_program(text);
    if (!program) return fail(Errc::Syntax, "member 'with': {}", program.error().what);
    release.named.push_back(*std::move(program));
  }
  return release;
}

Result<AcceptanceBody> decode_acceptance(std::string_view body) {
  if (body.empty()) return AcceptanceBody{};
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  const auto target = object->optional_text("as", kMaxName);
  AcceptanceBody acceptance;
  acceptance.reason = object->optional_text("comment", library::Releases::kMaxComment).value_or("");
  if (auto good = object->finish(); !good) return fail(good.error());
  if (!target) return acceptance;
  if (auto good = check_program_name(*target); !good) return fail(good.error());
  acceptance.target = *target;
  return acceptance;
}

Result<std::string> decode_rejection(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  auto reason = object->required_text("reason", library::Releases::kMaxComment);
  if (auto good = object->finish(); !good) return fail(good.error());
  return reason;
}

Result<std::string> decode_rename(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  auto to = object->required_text("to", kMaxName);
  if (auto good = object->finish(); !good) return fail(good.error());
  if (auto good = check_program_name(to); !good) return fail(good.error());
  return to;
}

}  // namespace dripline::api
