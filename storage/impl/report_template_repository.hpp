#pragma once

#include "storage/impl/connections.hpp"
#include "storage/report_template_store.hpp"

namespace dripline::storage {

class ReportTemplateRepository final : public ReportTemplateStore {
 public:
  explicit ReportTemplateRepository(Connections& connections) : connections_(connections) {}

  Result<ReportTemplateVersion> push(const ReportTemplateVersion& version,
                                     const Actor& who) override;
  Result<std::vector<ReportTemplateVersion>> list() override;
  Result<std::vector<ReportTemplateVersion>> versions(const std::string& name) override;
  Result<ReportTemplateVersion> find(const std::string& name,
                                     std::optional<std::uint64_t> version) override;
  Result<void> remove(const std::string& name, const Actor& who, UtcTime time) override;
  Result<void> assign(const TemplateAssignment& assignment, const Actor& who) override;
  Result<void> unassign(const TemplateAssignment& assignment, const Actor& who) override;
  Result<std::vector<TemplateAssignment>> assignments() override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
