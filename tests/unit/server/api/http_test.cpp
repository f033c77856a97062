// The API over a real socket.
#include "server/api/http_server.hpp"

#include <httplib.h>
#include <thread>

#include "clients/lib/client.hpp"
#include "clients/lib/event_stream.hpp"
#include "tests/unit/server/api/api_fixture.hpp"
#include "tests/unit/server/api/raw_peer.hpp"

namespace dripline::server_test {
namespace {

class Http : public ApiTest {
 protected:
  Http() {
    api::HttpOptions options;
    options.address = api::parse_http_address("127.0.0.1:0").value();
    options.handler_threads = 4;
    options.max_body = api::Api::kMaxBody;
    options.heartbeat = std::chrono::milliseconds(50);
    auto started = api::HttpServer::start(
        options,
        {.handle = [this](api::Request request) { return api_->handle(std::move(request)); },
         .judge = [this](api::Request& head) { return api_->judge(head); },
         .waits_for_machine = [this](const api::Request& r) { return api_->waits_for_machine(r); },
         .may_stop = [this](const api::Request& r) { return api_->may_stop(r); },
         .finds_run = [this](const api::Request& r) { return api_->finds_run(r); },
         .max_body = [this](const api::Request& r) { return api_->max_body(r); }});
    EXPECT_TRUE(started) << started.error().what;
    server_ = *std::move(started);
  }

  httplib::Client client(const std::string& token = kSecret) {
    httplib::Client client("127.0.0.1", server_->port());
    client.set_bearer_token_auth(token);
    client.set_read_timeout(20);
    return client;
  }

  std::unique_ptr<api::HttpServer> server_;
};

TEST_F(Http, AnswersJsonToWhoHasTheToken) {
  const auto answer = client().Get("/api/v1/server");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->get_header_value("Content-Type"), "application/json");
  EXPECT_EQ(Json::parse(answer->body)["name"], "office");
  const auto refused = client("wrong").Get("/api/v1/server");
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, 401);
}

TEST_F(Http, TakesAndGivesALargeProgram) {
  std::string text;
  while (text.size() < 9'000'000) text += fmt::format("N{} G01 X1.5 Z-2.25\n", text.size());
  auto http = client();
  const auto upload =
      http.Post("/api/v1/uploads", R"({"program":"O1","control":"centurion"})", "application/json");
  ASSERT_TRUE(upload);
  const std::string path = "/api/v1/uploads/" + Json::parse(upload->body).value("id", "");
  constexpr std::size_t kPiece = api::Api::kMaxPiece;
  for (std::size_t at = 0; at < text.size(); at += kPiece) {
    const auto piece = http.Put(path + "/content?offset=" + std::to_string(at),
                                text.substr(at, kPiece), "application/octet-stream");
    ASSERT_TRUE(piece && piece->status == 200) << (piece ? piece->body : "no answer");
  }
  ASSERT_EQ(http.Post(path + "/commit", "", "application/json")->status, 201);
  const auto content = http.Get("/api/v1/programs/O1/content");
  ASSERT_TRUE(content);
  EXPECT_EQ(content->get_header_value("Content-Length"), std::to_string(text.size()));
  EXPECT_TRUE(content->body == text);
  const auto range = http.Get("/api/v1/programs/O1/content", {{"Range", "bytes=5000000-5000009"}});
  ASSERT_TRUE(range);
  EXPECT_EQ(range->status, 206);
  EXPECT_EQ(range->body, text.substr(5'000'000, 10));
}

TEST_F(Http, TakesAPostOfOurClientThatHasNoBody) {
  ports::PortView view;
  view.port.name = "line-1";
  ports_.views.push_back(view);
  client::Client ours(
      client::ServerAddress{fmt::format("http://127.0.0.1:{}", server_->port()), kSecret, {}});
  const auto test = ours.test_port("line-1");
  ASSERT_TRUE(test) << test.error().what;
  EXPECT_EQ(test->findings.size(), 1u);
  const auto ports = ours.ports();
  ASSERT_TRUE(ports) << ports.error().what;
  EXPECT_EQ(ports->at(0).name, "line-1");
}

TEST_F(Http, StreamsWhatPassesOverALineToOurClient) {
  ports::PortView view;
  view.port.name = "line-1";
  ports_.views.push_back(view);
  auto stream = client::EventStream::of_port(
      {client::ServerAddress{fmt::format("http://127.0.0.1:{}", server_->port()), kSecret, {}}},
      "line-1");
  const auto publish = api::publish_traffic_to(events_);
  bool has_port = false, has_traffic = false;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!has_traffic && std::chrono::steady_clock::now() < end) {
    const auto item = stream.next(std::chrono::milliseconds(1000));
    if (!item) continue;
    if (std::get_if<client::Port>(&*item) != nullptr) {
      has_port = true;
      publish({"line-1", clock_.now(), ports::TrafficKind::Received, "\x13", ""});
    }
    if (const auto* traffic = std::get_if<client::Traffic>(&*item)) {
      has_traffic = true;
      EXPECT_EQ(traffic->bytes, "13");
      EXPECT_EQ(traffic->what, "received");
    }
  }
  EXPECT_TRUE(has_port);
  EXPECT_TRUE(has_traffic);
}

/// Whoever listens when the token is revoked hears nothing more.
TEST_F(Http, EndsTheStreamOfATokenThatIsRevoked) {
  const std::string secret = token_of("viewer");
  bool has_begun = false;
  const auto answer = client(secret).Get("/api/v1/events", [&](const char*, std::size_t) {
    if (std::exchange(has_begun, true)) return true;
    EXPECT_EQ(call("DELETE", "/api/v1/users/a-viewer/tokens/test").status, 204);
    return true;
  });
  ASSERT_TRUE(answer) << "the stream ended by itself";
  EXPECT_TRUE(has_begun);
  EXPECT_EQ(client(secret).Get("/api/v1/server")->status, 401);
}

TEST_F(Http, ReadsNoLargeBodyOfAStranger) {
  const std::string body =
      R"({"user":"admin","password":")" + std::string(1 << 20, 'x') + R"(","bearer":true})";
  httplib::Client stranger("127.0.0.1", server_->port());
  const auto answer = stranger.Post("/api/v1/session", body, "application/json");
  EXPECT_TRUE(!answer || answer->status == 413);
}

TEST_F(Http, EntersTheClientsAddressIntoTheAuditTrail) {
  EXPECT_EQ(client().Put("/api/v1/machine-groups/lathes", "", "application/json")->status, 201);
  const auto entry = audit_->entries({})->at(0);
  EXPECT_EQ(entry.action, "group.add");
  EXPECT_EQ(entry.who.address, "127.0.0.1");
  EXPECT_EQ(entry.who.credential, "local");
}

TEST_F(Http, RefusesDeepJsonAndBadUrls) {
  const std::string deep = std::string(10'000, '[') + std::string(10'000, ']');
  const auto answer = client().Post("/api/v1/runs", deep, "application/json");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 400);
  EXPECT_NE(answer->body.find("nested"), std::string::npos);
  const auto bad_url = client().Get("/api/v1/server?x=%zz");
  ASSERT_TRUE(bad_url);
  EXPECT_EQ(bad_url->status, 400);
}

TEST_F(Http, EndsTheConnectionOfABodyBeyondAllBounds) {
  const auto answer = client().Put("/api/v1/uploads/x/content?offset=0",
                                   std::string(api::Api::kMaxBody + 1, 'X'), "text/plain");
  EXPECT_TRUE(!answer || answer->status >= 400);
  EXPECT_EQ(client().Get("/api/v1/health")->status, 200);
}

/// What the server says to a head whose body does not come.
std::string answer_to_head(std::uint16_t port, std::string_view line, const std::string& token,
                           std::uint64_t size) {
  RawPeer peer(port);
  peer.send(fmt::format(
      "{} HTTP/1.1\r\nHost: h\r\nAuthorization: Bearer {}\r\nContent-Length: {}\r\n\r\n{{", line,
      token, size));
  return peer.read_until("\r\n\r\n", std::chrono::seconds(5)).substr(0, 12);
}

TEST_F(Http, JudgesByTheHeadWhatItCan) {
  const std::string viewer = token_of("viewer"), operates = token_of("operator");
  const auto answer = [&](std::string_view line, const std::string& token, std::uint64_t size) {
    return answer_to_head(server_->port(), line, token, size);
  };
  EXPECT_EQ(answer("POST /api/v1/nothing", viewer, 9), "HTTP/1.1 404");
  EXPECT_EQ(answer("POST /api/v1/machines", viewer, 9), "HTTP/1.1 405");
  EXPECT_EQ(answer("POST /api/v1/runs/r1/commands", viewer, 9), "HTTP/1.1 403");
  EXPECT_EQ(answer("POST /api/v1/ports/p1/test-rules", viewer, 4'000'000), "HTTP/1.1 413");
  EXPECT_EQ(answer("POST /api/v1/runs/r1/commands", operates, 20'000), "HTTP/1.1 413");
  EXPECT_EQ(answer("PUT /api/v1/uploads/u1/content?offset=0", viewer, 4'000'000), "HTTP/1.1 403");
}

/// With a stated length and without one.
TEST_F(Http, CarriesOutAHoldBetweenSlowBodiesOfAViewer) {
  const std::string viewer = token_of("viewer");
  const std::string run = stored_run(1);
  std::vector<RawPeer> slow;
  for (int i = 0; i < 240; ++i) {
    slow.emplace_back(server_->port());
    slow.back().send(
        fmt::format("POST /api/v1/ports/x/test-rules HTTP/1.1\r\nHost: h\r\nAuthorization: Bearer "
                    "{}\r\n{}",
                    viewer,
                    i % 2 == 0 ? "Transfer-Encoding: chunked\r\n\r\n1\r\n{"
                               : "Content-Length: 320000\r\n\r\n{"));
  }
  EXPECT_EQ(client().Get("/api/v1/health")->status, 200);
  const auto begun = std::chrono::steady_clock::now();
  const auto held = client().Post("/api/v1/runs/" + run + "/commands", R"({"action":"hold"})",
                                  "application/json");
  ASSERT_TRUE(held);
  EXPECT_EQ(held->status, 200) << held->body;
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(5));
}

TEST_F(Http, CarriesOutAHoldBetweenSignInsThatDoNotEnd) {
  const std::string run = stored_run(1);
  std::vector<RawPeer> strangers;
  for (int i = 0; i < 300; ++i) {
    strangers.emplace_back(server_->port());
    strangers.back().send(
        "POST /api/v1/session HTTP/1.1\r\nHost: h\r\nContent-Length: 900\r\n\r\n{");
  }
  EXPECT_EQ(client().Get("/api/v1/health")->status, 200);
  const auto held = client().Post("/api/v1/runs/" + run + "/commands", R"({"action":"hold"})",
                                  "application/json");
  ASSERT_TRUE(held);
  EXPECT_EQ(held->status, 200) << held->body;
  EXPECT_EQ(client().Get("/api/v1/machines")->status, 200) << "and everything else";
}

TEST_F(Http, FindsARunForWhoMayStopIt) {
  const std::string viewer = token_of("viewer"), operates = token_of("operator");
  const auto finds = [&](const std::string& method, const std::string& path,
                         const std::string& token) {
    api::Request head;
    head.method = method;
    head.target = api::parse_target(path).value();
    head.headers["authorization"] = "Bearer " + token;
    head.headers["content-length"] = "9";
    (void)api_->judge(head);
    return api_->finds_run(head);
  };
  EXPECT_TRUE(finds("GET", "/api/v1/machines", operates));
  EXPECT_TRUE(finds("GET", "/api/v1/runs?limit=1", operates));
  EXPECT_TRUE(finds("GET", "/api/v1/runs/r1", operates));
  EXPECT_FALSE(finds("GET", "/api/v1/runs/r1", viewer));
  EXPECT_FALSE(finds("GET", "/api/v1/runs/r1", "stranger"));
  EXPECT_FALSE(finds("POST", "/api/v1/runs", operates));
  EXPECT_FALSE(finds("GET", "/api/v1/programs", operates));
}

TEST_F(Http, StreamsAReportWhoseLengthIsNotKnown) {
  const auto answer = client().Get("/api/v1/reports/" + stored_run(2500) + "?format=text");
  ASSERT_TRUE(answer);
  EXPECT_EQ(std::count(answer->body.begin(), answer->body.end(), '\n'), 2500);
}

TEST_F(Http, StreamsEventsAndSignsOfLife) {
  show_machine("lathe-1");
  std::string heard;
  const auto listener = api::publish_to(events_);
  bool is_published = false;
  auto http = client();
  http.Get("/api/v1/events?machine=lathe-1", [&](const char* data, std::size_t length) {
    heard.append(data, length);
    if (!std::exchange(is_published, true)) {
      storage::Run run;
      run.id = "run-7";
      run.machine = "lathe-1";
      listener.on_run(run);
    }
    const bool has_all = heard.find("event: machine\ndata: {") != std::string::npos &&
                         heard.find("\"id\":\"run-7\"") != std::string::npos &&
                         heard.find(": alive") != std::string::npos;
    return !has_all;  // ends the connection
  });
  EXPECT_NE(heard.find("event: run\n"), std::string::npos) << heard;
  EXPECT_NE(heard.find(": alive"), std::string::npos) << heard;
}

TEST_F(Http, StopsWhileSomebodyListens) {
  std::atomic<bool> is_listening{false};
  std::thread listener([&] {
    auto http = client();
    http.Get("/api/v1/events", [&](const char*, std::size_t) { return is_listening = true; });
  });
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!is_listening && std::chrono::steady_clock::now() < limit) std::this_thread::yield();
  EXPECT_TRUE(is_listening);
  events_.close();
  server_.reset();
  listener.join();
}

TEST_F(Http, ServesManyAtOnce) {
  push("O1", "M30\n");
  std::vector<std::thread> threads;
  threads.reserve(8);
  std::atomic<int> good{0};
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] {
      auto http = client();
      http.set_keep_alive(true);
      for (int n = 0; n < 25; ++n) {
        const auto answer = http.Get("/api/v1/programs/O1/content");
        if (answer && answer->body == "M30\n") ++good;
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(good, 200);
}

TEST(HttpServer, RefusesToListenBeyondThisMachineWithoutTls) {
  api::HttpOptions options;
  options.address = api::parse_http_address("0.0.0.0:0").value();
  const auto server =
      api::HttpServer::start(options, {.handle = [](const auto&) { return api::Response{}; }});
  ASSERT_FALSE(server);
  EXPECT_EQ(server.error().code, Errc::Denied);
}

TEST(HttpServer, ReportsThatItsAddressIsTaken) {
  api::HttpOptions options;
  options.address = api::parse_http_address("127.0.0.1:0").value();
  const api::HttpHandlers handler{.handle = [](const auto&) { return api::no_content(); }};
  const auto first = api::HttpServer::start(options, handler);
  ASSERT_TRUE(first);
  options.address.port = (*first)->port();
  const auto second = api::HttpServer::start(options, handler);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Io);
  EXPECT_NE(second.error().what.find(options.address.text()), std::string::npos);
}

TEST(HttpServer, SpeaksTlsAndNamesACertificateItCannotRead) {
  api::HttpOptions options;
  options.address = api::parse_http_address("127.0.0.1:0").value();
  options.tls = api::TlsFiles{.certificate = "/nowhere/cert.pem", .key = "/nowhere/key.pem"};
  const api::HttpHandlers handler{.handle = [](const auto&) {
    return api::json_response(200, {{"status", "ok"}});
  }};
  EXPECT_EQ(api::HttpServer::start(options, handler).error().code, Errc::Io);

  const test_support::TemporaryFolder folder;
  options.tls =
      api::TlsFiles{.certificate = folder.path() / "cert.pem", .key = folder.path() / "key.pem"};
  const std::string make = fmt::format(
      "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 "
      "-subj /CN=localhost -out {} -keyout {} 2>/dev/null",
      options.tls->certificate, options.tls->key);
  ASSERT_EQ(std::system(make.c_str()), 0);
  const auto server = api::HttpServer::start(options, handler);
  ASSERT_TRUE(server) << server.error().what;
  const std::string get = fmt::format(
      "curl -sf --max-time 10 --cacert {} --connect-to localhost:443:127.0.0.1:{} "
      "https://localhost/api/v1/health | grep -q ok",
      options.tls->certificate, (*server)->port());
  EXPECT_EQ(std::system(get.c_str()), 0);
}

TEST(HttpServer, EndsAConnectionWhereTheAnswerSaysSo) {
  const api::HttpHandlers handler{.handle = [](const auto& request) {
    api::Response response = api::no_content();
    response.ends_connection = request.header("x-end") == "yes";
    return response;
  }};
  api::HttpOptions options;
  options.address = api::parse_http_address("127.0.0.1:0").value();
  const auto server = api::HttpServer::start(options, handler);
  ASSERT_TRUE(server) << server.error().what;
  RawPeer peer((*server)->port());
  peer.send("GET /go-on HTTP/1.1\r\nHost: h\r\n\r\n");
  EXPECT_NE(peer.read_until("\r\n\r\n").find("Connection: keep-alive"), std::string::npos);
  peer.send("GET /end HTTP/1.1\r\nHost: h\r\nX-End: yes\r\n\r\n");
  EXPECT_NE(peer.read_until("\r\n\r\n").find("Connection: close"), std::string::npos);
  EXPECT_TRUE(peer.wait_for_end());
}

TEST(HttpAddress, IsFreeUntilAnotherProgramListensThere) {
  for (const std::string host : {"127.0.0.1", "[::1]"}) {
    EXPECT_TRUE(api::check_free(*api::parse_http_address(host + ":0")));
    const auto server = api::HttpServer::start(
        {.address = *api::parse_http_address(host + ":0"), .tls = {}, .limits = {}}, {});
    if (!server && host == "[::1]") continue;  // a computer without IPv6
    ASSERT_TRUE(server) << server.error().what;
    const auto address = api::parse_http_address(fmt::format("{}:{}", host, (*server)->port()));
    const auto taken = api::check_free(*address);
    ASSERT_FALSE(taken);
    EXPECT_EQ(taken.error().code, Errc::Busy);
    EXPECT_EQ(taken.error().what, address->text() + " is in use");
  }
}

}  // namespace
}  // namespace dripline::server_test
