#include "clients/cli/exit_status.hpp"

#include "clients/cli/text/error_output.hpp"

namespace dripline::cli {

int exit_status(const client::Failure& failure) {
  using Kind = client::Failure::Kind;
  switch (failure.kind) {
    case Kind::Unreachable:
      return kExitUnreachable;
    case Kind::Denied:
      return kExitDenied;
    case Kind::Refused:
      return kExitNo;
    case Kind::BadReply:
      return failure.code == Errc::Corrupt ? kExitNo : kExitUnreachable;
    case Kind::Local:
      return kExitUsage;
  }
  return kExitNo;
}

int complain(const client::Failure& failure) {
  print_error("dnc: {}\n", failure.what);
  return exit_status(failure);
}

int complain(const Error& error) {
  return complain(client::Failure{client::Failure::Kind::Local, error.code, error.what});
}

}  // namespace dripline::cli
