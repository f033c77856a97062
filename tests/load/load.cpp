// How the cost of a server grows with its machines, and whether it keeps all records while it is
// killed. README.md beside it.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <thread>

#include <fmt/format.h>

#include "tests/load/event_watch.hpp"
#include "tests/load/shop.hpp"

namespace {

using namespace dripline::load;
using Seconds = std::chrono::duration<double>;

struct Options {
  std::vector<std::size_t> machines{10, 100, 300, 1000};
  double seconds = 30, changes = 5, records = 1, feeding = 0.1;
  int kills = 0;
  std::uint32_t cells = 64, discovery_ms = 250, lease_ms = 2000;
  std::string server;  ///< empty: the one beside this program
  std::string store;   ///< ShopOptions::store
  std::string events = "/api/v1/events";
  bool has_watch = true, is_json = false;
};

struct Figures {
  std::size_t machines = 0;
  double connected_s = 0;       ///< from the first gateway process to the last machine
  double connecting_cpu_s = 0;  ///< of the server
  double seconds = 0;
  ProcessUse server, gateways;  ///< CPU during `seconds`
  double own_cpu_s = 0;         ///< of the reader of the events
  Delays delays;
  double load_average = 0;
  int kills = 0;
  double longest_return_s = 0;  ///< from a kill until all machines are connected again
  Kept kept;
};

double own_cpu_seconds() {
  return use_of(::getpid()).cpu_seconds;
}

double load_average() {
  double average = 0;
  std::ifstream("/proc/loadavg") >> average;
  return average;
}

void measure(const Options& options, const Shop& shop, EventWatch& watch, Figures& figures) {
  watch.reset();
  const auto begin = std::chrono::steady_clock::now();
  const ProcessUse server = shop.server_use(), gateways = shop.gateways_use();
  const double own = own_cpu_seconds();
  std::this_thread::sleep_for(Seconds(options.seconds));
  figures.server = shop.server_use();
  figures.gateways = shop.gateways_use();
  figures.seconds = Seconds(std::chrono::steady_clock::now() - begin).count();
  figures.delays = watch.delays();
  figures.server.cpu_seconds -= server.cpu_seconds;
  figures.gateways.cpu_seconds -= gateways.cpu_seconds;
  figures.own_cpu_s = own_cpu_seconds() - own;
  figures.load_average = load_average();
}

void kill_again_and_again(const Options& options, Shop& shop, Figures& figures) {
  std::mt19937 random(20);  // NOLINT(cert-msc51-cpp): the same pauses every time
  std::uniform_real_distribution<double> pause(0.2, 3);
  for (; figures.kills < options.kills; ++figures.kills) {
    std::this_thread::sleep_for(Seconds(pause(random)));
    const auto killed = std::chrono::steady_clock::now();
    shop.kill_server();
    shop.start_server();
    shop.wait_connected();
    const double back = Seconds(std::chrono::steady_clock::now() - killed).count();
    figures.longest_return_s = std::max(figures.longest_return_s, back);
  }
}

Figures run(const Options& options, const std::string& programs, std::size_t machines) {
  Shop shop({.server = options.server.empty() ? programs + "/dncd" : options.server,
             .store = options.store,
             .programs = programs,
             .machines = machines,
             .changes = options.changes,
             .records = options.records,
             .cells = options.cells,
             .discovery_ms = options.discovery_ms,
             .lease_ms = options.lease_ms,
             .feeding = options.feeding});
  Figures figures;
  figures.machines = machines;
  shop.start_server();
  shop.push_program();
  const auto begin = std::chrono::steady_clock::now();
  shop.start_gateways();
  shop.wait_connected();
  figures.connected_s = Seconds(std::chrono::steady_clock::now() - begin).count();
  figures.connecting_cpu_s = shop.server_use().cpu_seconds;
  shop.start_runs();
  EventWatch watch(options.changes);
  if (options.has_watch) watch.start(shop.url(), shop.token(), options.events);
  std::this_thread::sleep_for(std::chrono::seconds(2));
  measure(options, shop, watch, figures);
  kill_again_and_again(options, shop, figures);
  figures.kept = shop.drain();
  return figures;
}

nlohmann::json to_json(const Figures& f) {
  const double count = static_cast<double>(f.machines);
  return {{"machines", f.machines},
          {"connected_s", f.connected_s},
          {"connecting_cpu_s", f.connecting_cpu_s},
          {"seconds", f.seconds},
          {"dncd_cores", f.server.cpu_seconds / f.seconds},
          {"dncd_cpu_ms_per_machine_s", 1000 * f.server.cpu_seconds / f.seconds / count},
          {"dncd_mib", static_cast<double>(f.server.memory_bytes) / (1 << 20)},
          {"dncd_threads", f.server.threads},
          {"gateways_cores", f.gateways.cpu_seconds / f.seconds},
          {"gateways_mib", static_cast<double>(f.gateways.memory_bytes) / (1 << 20)},
          {"watch_cores", f.own_cpu_s / f.seconds},
          {"load_average", f.load_average},
          {"statuses_seen_per_s", static_cast<double>(f.delays.seen) / f.seconds},
          {"machine_events_per_s", static_cast<double>(f.delays.events) / f.seconds},
          {"event_bytes_per_s", static_cast<double>(f.delays.bytes) / f.seconds},
          {"delay_median_ms", f.delays.median_ms},
          {"delay_p99_ms", f.delays.p99_ms},
          {"delay_max_ms", f.delays.max_ms},
          {"records_sent", f.kept.sent},
          {"records_stored", f.kept.stored},
          {"records_lost", f.kept.lost},
          {"records_damaged", f.kept.damaged},
          {"text_bytes", f.kept.text_bytes},
          {"damaged_texts", f.kept.damaged_texts},
          {"refused_statuses", f.kept.refused_statuses},
          {"kills", f.kills},
          {"longest_return_s", f.longest_return_s}};
}

void print(const Figures& f) {
  const double count = static_cast<double>(f.machines);
  fmt::print(
      "{:5} machines: dncd {:.3f} cores ({:.2f} ms a machine and second), {:.0f} MiB; delay median "
      "{:.0f}, 99 % {:.0f}, longest {:.0f} ms of {:.0f} statuses/s in {:.0f} events/s ({:.0f} "
      "KiB/s); connected in {:.1f} s ({:.1f} s CPU); records sent {}, stored {}, lost {}, damaged "
      "{}; text {:.1f} MiB, damaged {}; kills {}, back in {:.1f} s at most; tool: gateways {:.3f} "
      "cores, reader {:.3f}; load {:.1f}\n",
      f.machines, f.server.cpu_seconds / f.seconds, 1000 * f.server.cpu_seconds / f.seconds / count,
      static_cast<double>(f.server.memory_bytes) / (1 << 20), f.delays.median_ms, f.delays.p99_ms,
      f.delays.max_ms, static_cast<double>(f.delays.seen) / f.seconds,
      static_cast<double>(f.delays.events) / f.seconds,
      static_cast<double>(f.delays.bytes) / f.seconds / 1024, f.connected_s, f.connecting_cpu_s,
      f.kept.sent, f.kept.stored, f.kept.lost, f.kept.damaged,
      static_cast<double>(f.kept.text_bytes) / (1 << 20), f.kept.damaged_texts, f.kills,
      f.longest_return_s, f.gateways.cpu_seconds / f.seconds, f.own_cpu_s / f.seconds,
      f.load_average);
  std::fflush(stdout);
}

bool is_whole(const Figures& f) {
  return f.kept.sent > 0 && f.kept.lost == 0 && f.kept.damaged == 0 && f.kept.damaged_texts == 0;
}

int load_and_measure(int argc, char** argv) {
  Options options;
  bool is_unwatched = false;
  CLI::App app{"load: a dncd with many machines, measured. Status 1: a record or a text was lost."};
  app.add_option("--machines", options.machines, "Numbers of machines, one after the other")
      ->delimiter(',');
  app.add_option("--seconds", options.seconds, "Measure for so long");
  app.add_option("--changes", options.changes, "Status changes a second of each machine");
  app.add_option("--records", options.records, "Records a second of each machine");
  app.add_option("--feeding", options.feeding, "Share of the machines that pull their program");
  app.add_option("--kills", options.kills, "Kill the server so often after the measurement");
  app.add_option("--cells", options.cells, "Cells of the server and of the gateways");
  app.add_option("--discovery-ms", options.discovery_ms, "Between two announcements of DDS");
  app.add_option("--lease-ms", options.lease_ms, "Silence after which either end is lost");
  app.add_option("--server", options.server, "Another dncd than the one beside this program");
  app.add_option("--store", options.store, "URL of an empty PostgreSQL database, for one number");
  app.add_option("--events", options.events, "The event stream that is read");
  app.add_flag("--unwatched", is_unwatched, "Nobody reads the events");
  app.add_flag("--json", options.is_json, "One JSON object for each number of machines");
  CLI11_PARSE(app, argc, argv);
  options.has_watch = !is_unwatched;
  const auto programs = std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
  bool is_good = true;
  for (const std::size_t machines : options.machines) {
    const Figures figures = run(options, programs, machines);
    if (options.is_json) {
      fmt::print("{}\n", to_json(figures).dump());
      std::fflush(stdout);
    } else {
      print(figures);
    }
    is_good = is_good && is_whole(figures);
  }
  return is_good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return load_and_measure(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "load: %s\n", error.what());
    return 1;
  }
}
