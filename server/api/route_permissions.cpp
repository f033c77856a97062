#include "server/api/route_permissions.hpp"

#include <algorithm>
#include <array>

namespace dripline::api {
namespace {

using enum identity::Permission;
using enum MachineIn;
using enum BodyKind;

constexpr std::array kRoutes{
    RoutePermission{"GET", "/api/v1/health", Open},
    RoutePermission{"GET", "/api/v1/ready", Open},
    RoutePermission{"GET", "/api/v1/openapi.json", Open},
    RoutePermission{"GET", "/api/v1/server", View},
    RoutePermission{"POST", "/api/v1/server/drain", Administer},
    RoutePermission{"GET", "/api/v1/audit", Approve},
    RoutePermission{"GET", "/api/v1/audit/export", Approve},
    RoutePermission{"GET", "/api/v1/audit/verification", Approve},
    RoutePermission{"POST", "/api/v1/audit/verification", Approve},
    RoutePermission{"GET", "/api/v1/events", View},
    RoutePermission{"GET", "/api/v1/certificates", View},
    RoutePermission{"GET", "/api/v1/metrics", View},

    RoutePermission{"GET", "/api/v1/backups", Administer},
    RoutePermission{"POST", "/api/v1/backups", Administer},
    RoutePermission{"DELETE", "/api/v1/backups/{id}", Administer},
    RoutePermission{"POST", "/api/v1/backups/{id}/verify", Administer},

    RoutePermission{"GET", "/api/v1/webhooks", Administer},
    RoutePermission{"POST", "/api/v1/webhooks", Administer},
    RoutePermission{"DELETE", "/api/v1/webhooks/{name}", Administer},
    RoutePermission{"POST", "/api/v1/webhooks/{name}/test", Administer},

    RoutePermission{"POST", "/api/v1/session", Open},
    RoutePermission{"GET", "/api/v1/session", SignedIn},
    RoutePermission{"DELETE", "/api/v1/session", SignedIn},
    RoutePermission{"GET", "/api/v1/users", Administer},
    RoutePermission{"POST", "/api/v1/users", Administer},
    RoutePermission{"GET", "/api/v1/users/{name}", SignedIn},
    RoutePermission{"PUT", "/api/v1/users/{name}", Administer},
    RoutePermission{"DELETE", "/api/v1/users/{name}", Administer},
    RoutePermission{"PUT", "/api/v1/users/{name}/password", SignedIn},
    RoutePermission{"GET", "/api/v1/users/{name}/tokens", SignedIn},
    RoutePermission{"POST", "/api/v1/users/{name}/tokens", SignedIn},
    RoutePermission{"DELETE", "/api/v1/users/{name}/tokens/{token}", SignedIn},
    RoutePermission{"GET", "/api/v1/machine-groups", View},
    RoutePermission{"PUT", "/api/v1/machine-groups/{group}", Administer},
    RoutePermission{"DELETE", "/api/v1/machine-groups/{group}", Administer},
    RoutePermission{"PUT", "/api/v1/machine-groups/{group}/machines/{machine}", Administer},
    RoutePermission{"DELETE", "/api/v1/machine-groups/{group}/machines/{machine}", Administer},

    RoutePermission{"GET", "/api/v1/programs", View},
    RoutePermission{"GET", "/api/v1/programs/{name}", View},
    RoutePermission{"DELETE", "/api/v1/programs/{name}", Program},
    RoutePermission{"PUT", "/api/v1/programs/{name}/fields", Program},
    RoutePermission{"GET", "/api/v1/programs/{name}/attachments", View},
    RoutePermission{"POST", "/api/v1/programs/{name}/attachments", Program},
    RoutePermission{"GET", "/api/v1/programs/{name}/attachments/{attachment}", View},
    RoutePermission{"DELETE", "/api/v1/programs/{name}/attachments/{attachment}", Program},
    RoutePermission{"POST", "/api/v1/programs/{name}/copy", Program},
    RoutePermission{"POST", "/api/v1/programs/{name}/rename", Program},
    RoutePermission{"POST", "/api/v1/programs/{name}/revisions/{number}/accept", Approve},
    RoutePermission{"POST", "/api/v1/programs/{name}/revisions/{number}/reject", Approve},
    RoutePermission{"GET", "/api/v1/programs/{name}/revisions/{number}/states", View},
    RoutePermission{"POST", "/api/v1/programs/{name}/revisions/{number}/submit", Program},
    RoutePermission{"POST", "/api/v1/programs/{name}/revisions/{number}/approve", Approve},
    RoutePermission{"POST", "/api/v1/programs/{name}/revisions/{number}/release", Approve},
    RoutePermission{"POST", "/api/v1/programs/{name}/revisions/{number}/withdraw", Approve},
    RoutePermission{"GET", "/api/v1/programs/{name}/closure", View},
    RoutePermission{"GET", "/api/v1/release-policy", View},
    RoutePermission{"GET", "/api/v1/imports", View},
    RoutePermission{"GET", "/api/v1/imports/{name}/{number}", View},
    RoutePermission{"POST", "/api/v1/imports/{name}/{number}/accept", Approve},
    RoutePermission{"POST", "/api/v1/imports/{name}/{number}/reject", Approve},
    RoutePermission{"GET", "/api/v1/folders", View},
    RoutePermission{"GET", "/api/v1/folders/{name}/files", View},
    RoutePermission{"GET", "/api/v1/programs/{name}/content", View},
    RoutePermission{"GET", "/api/v1/programs/{name}/path", View},
    RoutePermission{"GET", "/api/v1/programs/{name}/comparison", View},
    RoutePermission{"GET", "/api/v1/programs/{name}/check", View},
    RoutePermission{"POST", "/api/v1/uploads", Program},
    RoutePermission{"GET", "/api/v1/uploads/{id}", Program},
    RoutePermission{"PUT", "/api/v1/uploads/{id}/content", Program, Nowhere, Piece},
    RoutePermission{"POST", "/api/v1/uploads/{id}/commit", Program},
    RoutePermission{"POST", "/api/v1/uploads/{id}/attach", Program},
    RoutePermission{"DELETE", "/api/v1/uploads/{id}", Program},
    RoutePermission{"GET", "/api/v1/search", View},

    RoutePermission{"GET", "/api/v1/machines", View},
    RoutePermission{"GET", "/api/v1/machines/{name}", View},
    RoutePermission{"POST", "/api/v1/machines/{name}/commands", Operate, Name, Command},
    RoutePermission{"POST", "/api/v1/machines/{name}/confirm-gateway", Operate, Name},
    RoutePermission{"POST", "/api/v1/machines/{name}/mdi", Operate, Name},
    RoutePermission{"POST", "/api/v1/machines/{name}/datum", Operate, Name},
    RoutePermission{"POST", "/api/v1/machines/{name}/touch-off", Operate, Name},
    RoutePermission{"POST", "/api/v1/machines/{name}/jog", Operate, Name},
    RoutePermission{"POST", "/api/v1/machines/{name}/jog/hold", Operate, Name},
    RoutePermission{"GET", "/api/v1/machines/{name}/playback", View},
    RoutePermission{"GET", "/api/v1/machines/{name}/jobs", View},
    RoutePermission{"POST", "/api/v1/machines/{name}/jobs", Operate, Name},
    RoutePermission{"PUT", "/api/v1/machines/{name}/jobs/{job}", Operate, Name},
    RoutePermission{"DELETE", "/api/v1/machines/{name}/jobs/{job}", Operate, Name},
    RoutePermission{"POST", "/api/v1/machines/{name}/start-job", Operate, Name},
    RoutePermission{"PUT", "/api/v1/machines/{name}/job-hold", Operate, Name},
    RoutePermission{"DELETE", "/api/v1/machines/{name}/job-hold", Operate, Name},
    RoutePermission{"GET", "/api/v1/machines/{name}/setups", View},
    RoutePermission{"GET", "/api/v1/machines/{name}/setup", View},
    RoutePermission{"PUT", "/api/v1/machines/{name}/setup", SetUp, Name},
    RoutePermission{"GET", "/api/v1/machines/{name}/setup/loaded", View},
    RoutePermission{"PUT", "/api/v1/machines/{name}/setup/loaded", Operate, Name},
    RoutePermission{"GET", "/api/v1/machines/{name}/memory", View},
    RoutePermission{"GET", "/api/v1/machines/{name}/values", View},

    RoutePermission{"POST", "/api/v1/runs", Operate, Start},
    RoutePermission{"GET", "/api/v1/runs", View},
    RoutePermission{"GET", "/api/v1/runs/{id}", View},
    RoutePermission{"GET", "/api/v1/runs/{id}/attestation", View},
    RoutePermission{"POST", "/api/v1/runs/{id}/restart", Operate, Run},
    RoutePermission{"POST", "/api/v1/runs/{id}/commands", Operate, Run, Command},
    RoutePermission{"GET", "/api/v1/runs/{id}/records", View},
    RoutePermission{"GET", "/api/v1/machine-reports", View},
    RoutePermission{"GET", "/api/v1/machines/{name}/report", View},
    RoutePermission{"GET", "/api/v1/reports", View},
    RoutePermission{"GET", "/api/v1/reports/{run}", View},

    RoutePermission{"GET", "/api/v1/archives", Administer},
    RoutePermission{"POST", "/api/v1/archives", Administer},
    RoutePermission{"GET", "/api/v1/archives/{id}/rows", Administer},
    RoutePermission{"GET", "/api/v1/measurements", View},
    RoutePermission{"GET", "/api/v1/measurements/chart", View},
    RoutePermission{"GET", "/api/v1/measurements/capability", View},
    RoutePermission{"GET", "/api/v1/measurements/gauge", View},
    RoutePermission{"GET", "/api/v1/characteristics", View},
    RoutePermission{"GET", "/api/v1/offsets", View},
    RoutePermission{"GET", "/api/v1/offsets/{id}", View},
    RoutePermission{"POST", "/api/v1/machines/{name}/offsets/{id}/approve", Approve, Name},
    RoutePermission{"POST", "/api/v1/machines/{name}/offsets/{id}/reject", Approve, Name},
    RoutePermission{"POST", "/api/v1/machines/{name}/offsets/evaluation", SetUp, Name},
    RoutePermission{"GET", "/api/v1/machines/{name}/offset-rules", View},
    RoutePermission{"PUT", "/api/v1/machines/{name}/offset-rules", Approve, Name},
    RoutePermission{"GET", "/api/v1/machines/{name}/offset-history", View},
    RoutePermission{"GET", "/api/v1/runs/{id}/offsets", View},
    RoutePermission{"GET", "/api/v1/parts", View},
    RoutePermission{"GET", "/api/v1/parts/{id}", View},
    RoutePermission{"GET", "/api/v1/report-findings", View},
    RoutePermission{"POST", "/api/v1/runs/{id}/measurements", Program},
    RoutePermission{"POST", "/api/v1/runs/{id}/template-trial", View},
    RoutePermission{"GET", "/api/v1/report-templates", View},
    RoutePermission{"GET", "/api/v1/report-templates/{name}", View},
    RoutePermission{"PUT", "/api/v1/report-templates/{name}", Program},
    RoutePermission{"DELETE", "/api/v1/report-templates/{name}", Program},
    RoutePermission{"GET", "/api/v1/report-template-assignments", View},
    RoutePermission{"PUT", "/api/v1/report-template-assignments/{scope}/{subject}/{template}",
                    Program, Subject},
    RoutePermission{"DELETE", "/api/v1/report-template-assignments/{scope}/{subject}/{template}",
                    Program, Subject},

    RoutePermission{"GET", "/api/v1/ports", View},
    RoutePermission{"GET", "/api/v1/ports/{name}", View},
    RoutePermission{"PUT", "/api/v1/ports/{name}", Administer},
    RoutePermission{"DELETE", "/api/v1/ports/{name}", Administer},
    RoutePermission{"POST", "/api/v1/ports/{name}/test", Administer},
    RoutePermission{"POST", "/api/v1/ports/{name}/test-rules", View},
    RoutePermission{"POST", "/api/v1/ports/{name}/transfers", Operate, Port},
    RoutePermission{"POST", "/api/v1/ports/{name}/receive", Operate, Port},
    RoutePermission{"POST", "/api/v1/ports/{name}/confirm-reset", Operate, Port},
    RoutePermission{"DELETE", "/api/v1/ports/{name}/transfers", Operate, Port, Command},
    RoutePermission{"GET", "/api/v1/ports/{name}/recording", View},
    RoutePermission{"GET", "/api/v1/ports/{name}/traffic", View},
    RoutePermission{"GET", "/api/v1/port-templates", View},
};

}  // namespace

std::span<const RoutePermission> route_permissions() {
  return kRoutes;
}

const RoutePermission* find_permission(std::string_view method, std::string_view pattern) {
  const auto found = std::ranges::find_if(kRoutes, [&](const RoutePermission& row) {
    return row.method == method && row.pattern == pattern;
  });
  return found == kRoutes.end() ? nullptr : &*found;
}

}  // namespace dripline::api
