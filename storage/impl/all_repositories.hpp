#pragma once

#include "storage/impl/account_repository.hpp"
#include "storage/impl/archive_repository.hpp"
#include "storage/impl/job_repository.hpp"
#include "storage/impl/measurement_repository.hpp"
#include "storage/impl/offset_repository.hpp"
#include "storage/impl/programs/attachment_repository.hpp"
#include "storage/impl/programs/folder_repository.hpp"
#include "storage/impl/programs/import_repository.hpp"
#include "storage/impl/programs/program_repository.hpp"
#include "storage/impl/programs/release_repository.hpp"
#include "storage/impl/programs/search_repository.hpp"
#include "storage/impl/programs/upload_repository.hpp"
#include "storage/impl/record_reader_repository.hpp"
#include "storage/impl/report_template_repository.hpp"
#include "storage/impl/repositories.hpp"
#include "storage/impl/webhook_repository.hpp"
#include "storage/store.hpp"

namespace dripline::storage {

/// Every interface of a store, over one engine's connections.
struct Repositories {
  /// Connections must outlive it.
  Repositories(Connections& opened, const Clock& clock, const Caches& caches)
      : programs(opened, clock, caches),
        uploads(opened, clock),
        machines(opened),
        runs(opened, clock),
        records(opened, clock),
        ports(opened),
        setups(opened, clock),
        audit(opened),
        accounts(opened),
        releases(opened),
        imports(opened),
        report_templates(opened),
        measurements(opened),
        archives(opened),
        offsets(opened),
        attachments(opened, uploads, clock),
        search(opened),
        folders(opened),
        jobs(opened),
        webhooks(opened),
        record_readers(opened) {}

  Repositories(const Repositories&) = delete;
  Repositories& operator=(const Repositories&) = delete;

  Store store() {
    return {programs,     uploads,  machines,      runs,        records, ports,
            setups,       audit,    accounts,      releases,    imports, report_templates,
            measurements, archives, offsets,       attachments, search,  folders,
            jobs,         webhooks, record_readers};
  }

  ProgramRepository programs;
  UploadRepository uploads;
  MachineRepository machines;
  RunRepository runs;
  RecordRepository records;
  PortRepository ports;
  SetupRepository setups;
  AuditRepository audit;
  AccountRepository accounts;
  ReleaseRepository releases;
  ImportRepository imports;
  ReportTemplateRepository report_templates;
  MeasurementRepository measurements;
  ArchiveRepository archives;
  OffsetRepository offsets;
  AttachmentRepository attachments;
  SearchRepository search;
  FolderRepository folders;
  JobRepository jobs;
  WebhookRepository webhooks;
  RecordReaderRepository record_readers;
};

}  // namespace dripline::storage
