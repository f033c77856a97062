#pragma once

#include "storage/account_store.hpp"
#include "storage/archive_store.hpp"
#include "storage/audit_store.hpp"
#include "storage/job_store.hpp"
#include "storage/machine_store.hpp"
#include "storage/measurement_store.hpp"
#include "storage/offset_store.hpp"
#include "storage/port_store.hpp"
#include "storage/programs/attachment_store.hpp"
#include "storage/programs/folder_store.hpp"
#include "storage/programs/import_store.hpp"
#include "storage/programs/program_store.hpp"
#include "storage/programs/release_store.hpp"
#include "storage/programs/search_store.hpp"
#include "storage/programs/upload_store.hpp"
#include "storage/record_reader_store.hpp"
#include "storage/record_store.hpp"
#include "storage/report_template_store.hpp"
#include "storage/run_store.hpp"
#include "storage/setup_store.hpp"
#include "storage/webhook_store.hpp"

namespace dripline::storage {

/// What the server keeps, in domain words: twenty-one interfaces, so that a service names the ones
/// it needs. What opens a store also checks it (`SqliteStore`: check, probe, identity). Every
/// function may be called from any thread; each is one transaction. When it has returned success,
/// what it wrote is on disk. Errors everywhere: Io, Busy, Corrupt (stored bytes fail their check).
struct Store {
  ProgramStore& programs;
  UploadStore& uploads;
  MachineStore& machines;
  RunStore& runs;
  RecordStore& records;
  PortStore& ports;
  SetupStore& setups;
  AuditStore& audit;
  AccountStore& accounts;
  ReleaseStore& releases;
  ImportStore& imports;
  ReportTemplateStore& report_templates;
  MeasurementStore& measurements;
  ArchiveStore& archives;
  OffsetStore& offsets;
  AttachmentStore& attachments;
  SearchStore& search;
  FolderStore& folders;
  JobStore& jobs;
  WebhookStore& webhooks;
  RecordReaderStore& record_readers;
};

}  // namespace dripline::storage
