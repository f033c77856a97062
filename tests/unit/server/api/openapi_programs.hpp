#pragma once

#include "tests/unit/server/api/openapi_fixture.hpp"

namespace dripline::server_test {

/// The answers about programs: where they come from, who judges them, what is to be made of them.
class ProgramAnswers : public OpenApi {
 protected:
  void expect_judgment_described() {
    for (const std::string number : {"1", "2"}) {
      const auto upload = programs_->begin(
          {.program = "O3", .control = "centurion", .comment = {}, .is_held = true}, "mill-3");
      ASSERT_TRUE(programs_->append(upload->id, 0, bytes_of("N" + number + "\n")));
      ASSERT_TRUE(programs_->commit(upload->id, std::nullopt, "mill-3"));
    }
    expect_described("GET", "/api/v1/programs", get("/api/v1/programs"));
    expect_imports_described();
    const std::string path = "/api/v1/programs/{name}/revisions/{number}/";
    expect_described("POST", path + "accept",
                     call("POST", "/api/v1/programs/O3/revisions/1/accept"));
    expect_described("POST", path + "reject",
                     call("POST", "/api/v1/programs/O3/revisions/2/reject"));
    // Accepted, it is a draft like any other.
    const Call comment{.body = R"({"comment":"why"})", .headers = {}};
    for (const std::string step :
         {"submit", "approve", "reject", "submit", "approve", "release", "withdraw"}) {
      const auto decided = call("POST", "/api/v1/programs/O3/revisions/1/" + step, comment);
      EXPECT_EQ(decided.status, 200) << step << decided.body;
      expect_described("POST", path + step, decided);
    }
    expect_described("GET", path + "states", get("/api/v1/programs/O3/revisions/1/states"));
    expect_described("GET", "/api/v1/release-policy", get("/api/v1/release-policy"));
  }

  void expect_imports_described() {
    push("O4", "N1\n");
    for (const std::string number : {"2", "3", "4"}) {
      const auto upload = programs_->begin(
          {.program = "O4", .control = "centurion", .comment = {}, .is_held = true},
          "machine mill-3");
      ASSERT_TRUE(programs_->append(upload->id, 0, bytes_of("N" + number + "\n")));
      ASSERT_TRUE(programs_->commit(upload->id, std::nullopt, "machine mill-3"));
    }
    ASSERT_TRUE(store_->imports.set_class(
        "O4", 2, {.base = 1, .edit = "comment", .fault = "x", .time = clock_.now()}));
    const std::string path = "/api/v1/imports/{name}/{number}";
    expect_described("GET", "/api/v1/imports", get("/api/v1/imports"));
    expect_described("GET", path, get("/api/v1/imports/O4/2"));
    expect_described("POST", path + "/accept", call("POST", "/api/v1/imports/O4/2/accept"));
    const auto moved = post("/api/v1/imports/O4/3/accept", {{"as", "O5"}, {"comment", "variant"}});
    EXPECT_EQ(moved.status, 200) << moved.body;
    expect_described("POST", path + "/accept", moved);
    const auto rejected = post("/api/v1/imports/O4/4/reject", {{"reason", "scrap"}});
    EXPECT_EQ(rejected.status, 204) << rejected.body;
    expect_described("POST", path + "/reject", rejected);
    expect_described("GET", "/api/v1/imports", get("/api/v1/imports?state=decided"));
    for (const std::string number : {"2", "3", "4"})
      expect_described("GET", path, get("/api/v1/imports/O4/" + number));
  }

  void expect_library_described() {
    push("O6", "O6\nM98 P7\nM98 P8\nCALL [P1]\nM30\n");
    push("O7", "O7\nM99\n");
    const std::string program = "/api/v1/programs/{name}", of = "/api/v1/programs/O6";
    const auto closure = get(of + "/closure?with=O2");
    EXPECT_EQ(json(closure)["missing"].size(), 1u) << closure.body;
    expect_described("GET", program + "/closure", closure);
    const auto described = call("PUT", of + "/fields",
                                {.body = R"({"part":"4711","cam_file":"o6.f3d"})", .headers = {}});
    EXPECT_EQ(described.status, 200) << described.body;
    expect_described("PUT", program + "/fields", described);
    const auto upload = post(of + "/attachments", {{"name", "setup.pdf"}, {"comment", "side 1"}});
    expect_described("POST", program + "/attachments", upload);
    const std::string path = "/api/v1/uploads/" + json(upload).value("id", "");
    EXPECT_EQ(call("PUT", path + "/content?offset=0", {.body = "%PDF", .headers = {}}).status, 200);
    const auto attached = call("POST", path + "/attach");
    EXPECT_EQ(attached.status, 201) << attached.body;
    expect_described("POST", "/api/v1/uploads/{id}/attach", attached);
    expect_described("GET", program + "/attachments", get(of + "/attachments"));
    const std::string one = program + "/attachments/{attachment}";
    expect_described("GET", one, get(of + "/attachments/setup.pdf"));
    EXPECT_TRUE(test_support::eventually(
        [&] { return json(get("/api/v1/search?words=4711"))["hits"].size() == 1; }));
    expect_described("GET", "/api/v1/search", get("/api/v1/search?words=4711"));
    expect_described("DELETE", one, call("DELETE", of + "/attachments/setup.pdf"));
    for (const std::string name : {"O6", "O7"}) {
      for (const std::string step : {"submit", "approve"})
        EXPECT_EQ(call("POST", "/api/v1/programs/" + name + "/revisions/1/" + step).status, 200);
    }
    push("O8", "O8\nM99\n");
    for (const std::string step : {"submit", "approve"})
      EXPECT_EQ(call("POST", "/api/v1/programs/O8/revisions/1/" + step).status, 200);
    const auto released = post(of + "/revisions/1/release", {{"closure", true}, {"with", {"O7"}}});
    EXPECT_EQ(released.status, 200) << released.body;
    expect_described("GET", program + "/revisions/{number}/states",
                     get(of + "/revisions/1/states"));
  }

  void expect_jobs_described() {
    const std::string machine = "/api/v1/machines/{name}", lathe = "/api/v1/machines/lathe-1";
    add_machine("lathe-1");
    const auto events = events_.subscribe({"lathe-1"});
    const auto added = post(lathe + "/jobs", {{"program", "O4"}, {"comment", "steel"}});
    EXPECT_EQ(added.status, 201) << added.body;
    expect_described("POST", machine + "/jobs", added);
    const auto pinned = post(lathe + "/jobs", {{"program", "O4"}, {"revision", 1}});
    const std::string job = lathe + "/jobs/" + json(pinned)["id"].dump();
    expect_described("PUT", machine + "/jobs/{job}",
                     call("PUT", job, {.body = R"({"place":1})", .headers = {}}));
    expect_described("POST", machine + "/start-job", post(lathe + "/start-job", Json::object()));
    expect_described(
        "PUT", machine + "/job-hold",
        call("PUT", lathe + "/job-hold", {.body = R"({"reason":"wide"})", .headers = {}}));
    expect_described("GET", machine + "/jobs", get(lathe + "/jobs"));
    expect_described("DELETE", machine + "/job-hold", call("DELETE", lathe + "/job-hold"));
    expect_described("DELETE", machine + "/jobs/{job}", call("DELETE", job));
    expect_described("GET", machine + "/jobs", get(lathe + "/jobs?state=closed"));
    std::istringstream stream(events->take());
    std::size_t changes = 0;
    for (std::string line; std::getline(stream, line);) {
      if (!line.starts_with("data: ")) continue;
      expect_line_described("JobChange", line.substr(6));
      ++changes;
    }
    EXPECT_EQ(changes, 6u);  // two added, moved, held, released, removed
  }

  void expect_folders_and_webhooks_described() {
    storage::FolderFile file;
    file.folder = "cam";
    file.name = "1\n.nc";
    file.state = storage::FolderFileState::Failed;
    file.reason = "its name";
    file.taken = clock_.now();
    ASSERT_TRUE(store_->folders.begin(file));
    expect_described("GET", "/api/v1/folders", get("/api/v1/folders"));
    const auto files = get("/api/v1/folders/cam/files");
    EXPECT_EQ(json(files)["files"][0]["name"], "1%0A.nc");
    expect_described("GET", "/api/v1/folders/{name}/files", files);
    const std::string hook = "/api/v1/webhooks/{name}";
    const auto added = post("/api/v1/webhooks", {{"name", "erp"}, {"url", "http://erp/"}});
    EXPECT_EQ(added.status, 201) << added.body;
    EXPECT_EQ(json(added)["secret"].get<std::string>().size(), 64u);
    expect_described("POST", "/api/v1/webhooks", added);
    const auto listed = get("/api/v1/webhooks");
    EXPECT_EQ(listed.body.find("secret"), std::string::npos) << "shown once";
    expect_described("GET", "/api/v1/webhooks", listed);
    expect_described("POST", hook + "/test", call("POST", "/api/v1/webhooks/erp/test"));
    EXPECT_EQ(sender_.sent.size(), 1u);
    expect_described("DELETE", hook, call("DELETE", "/api/v1/webhooks/erp"));
  }
};

}  // namespace dripline::server_test
