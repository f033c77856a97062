#include "tests/unit/clients/dnc/dnc_process.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace dripline::test_support {

std::vector<std::string> Dnc::command(const std::vector<std::string>& arguments) const {
  std::vector<std::string> all{
      "/usr/bin/env",       "-i", "-C", folder_.path().string(), "HOME=" + folder_.path().string(),
      "DRIPLINE_STATE=none"};
  for (const auto& [name, value] : environment) all.push_back(fmt::format("{}={}", name, value));
  all.push_back(program_);
  all.insert(all.end(), arguments.begin(), arguments.end());
  return all;
}

DncResult Dnc::operator()(const std::vector<std::string>& arguments) const {
  const std::string out = (folder_.path() / "stdout.txt").string();
  std::vector<std::string> all{"/bin/sh", "-c", "out=$1; shift; exec \"$@\" >\"$out\"", "sh", out};
  for (auto& word : command(arguments)) all.push_back(std::move(word));
  const auto finished = run_to_end(all, folder_.path() / "stderr.txt");
  return {finished.status, read("stdout.txt"), finished.output};
}

ChildProcess Dnc::start(const std::vector<std::string>& arguments) const {
  return ChildProcess(command(arguments), folder_.path() / "started.txt");
}

std::string Dnc::write(const std::string& name, const std::string& text) const {
  const auto path = folder_.path() / name;
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

std::string Dnc::read(const std::string& name) const {
  std::ifstream file(folder_.path() / name, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace dripline::test_support
