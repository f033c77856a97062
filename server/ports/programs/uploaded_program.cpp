#include "server/ports/programs/uploaded_program.hpp"

#include "gateway/line/inbound/program_head.hpp"
#include "protocol/base/names.hpp"

namespace dripline::ports {

std::string fit_program_name(std::string_view name) {
  constexpr std::string_view kSigns = " ._-+";
  std::string fit;
  for (const char c : name.substr(0, kMaxProgramName)) {
    const bool is_good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                         (c >= '0' && c <= '9') || kSigns.find(c) != kSigns.npos;
    fit += is_good ? c : '-';
  }
  const auto first = fit.find_first_not_of(" .");
  if (first == std::string::npos) return {};
  fit.erase(0, first);
  fit.erase(fit.find_last_not_of(' ') + 1);
  return fit;
}

UploadedProgram::~UploadedProgram() {
  // What cannot be abandoned now is dropped after a day.
  if (!upload_.empty()) (void)programs_.abandon(upload_).has_value();
}

Result<void> UploadedProgram::append(const std::string& text) {
  if (error_) return fail(*error_);
  text_ += text;
  if (text_.size() < kInMemory) return {};
  const std::string name = fit_program_name(line::program_name(text_));
  if (auto spilled = spill(name.empty() ? fallback_name() : name); !spilled) return spilled;
  if (damages_ > 0) error_ = Error{Errc::Corrupt, "it came damaged: " + first_damage_};
  return {};
}

void UploadedProgram::damage(const std::string& how) {
  if (damages_++ == 0) first_damage_ = how;
  if (upload_.empty() || error_) return;
  error_ = Error{Errc::Corrupt, "it came damaged: " + how};
}

std::string UploadedProgram::comment() const {
  std::string text = "punched by " + origin_.machine;
  if (damages_ > 0)
    text += fmt::format("{}{} times, first: {}", library::Programs::kDamageMark, damages_,
                        first_damage_);
  return text.substr(0, library::Programs::kMaxComment);
}

Result<void> UploadedProgram::spill(const std::string& name) {
  const auto keep = [this](const Error& error) {
    error_ = error;
    return fail(error);
  };
  if (upload_.empty()) {
    auto upload = programs_.begin(
        {.program = name, .control = origin_.control, .comment = comment(), .is_held = true},
        who());
    if (!upload) return keep(upload.error());
    upload_ = upload->id;
    upload_name_ = name;
  }
  const auto appended =
      programs_.append(upload_, spilled_, std::as_bytes(std::span<const char>(text_)));
  if (!appended) return keep(appended.error());
  spilled_ += text_.size();
  text_.clear();
  return {};
}

Result<library::Committed> UploadedProgram::store(const std::string& name) {
  if (error_) return fail(*error_);
  const std::string fit = fit_program_name(name);
  if (auto spilled = spill(fit.empty() ? fallback_name() : fit); !spilled) {
    return fail(spilled.error());
  }
  auto committed = programs_.commit(upload_, std::nullopt, who());
  if (committed) upload_.clear();
  return committed;
}

}  // namespace dripline::ports
