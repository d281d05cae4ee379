// Files on disk survive failure; JSON and JUnit read back what was put in.
#include "reports/files.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/folder.hpp"
#include "tests/messages.hpp"
#include "tests/text.hpp"

BOOST_AUTO_TEST_SUITE(files)

namespace {

namespace fs = std::filesystem;
using diptych::tests::contents;
using diptych::tests::Folder;
using diptych::tests::holds;
using diptych::tests::lines;
using diptych::tests::says;
using namespace diptych::reports;

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Makes the disk look full: no file may grow beyond `bytes`.
struct FullDisk {
  explicit FullDisk(rlim_t bytes) : handler(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before);
    rlimit limit = before;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
  }
  rlimit before{};
  void (*handler)(int);
};

std::vector<nlohmann::json> parsed(const std::string& jsonl) {
  std::vector<nlohmann::json> found;
  for (const std::string& line : lines(jsonl)) found.push_back(nlohmann::json::parse(line));
  return found;
}

Case example() {
  Case data;
  data.id = "bar <1>";
  data.path = "cases/bar.toml";
  Run run;
  run.case_id = data.id;
  run.method = "mpm-usf";
  run.cells = 200;
  run.particles = "0.5";
  run.parameters = "v0=0.1";
  run.status = "completed";
  run.courant = 0.1 + 0.2;
  run.time_step_limit = 2e-6;
  run.particle_steps = 5000000000;
  run.bytes = 4096;
  run.features = {"elastic", "viscosity"};
  run.measures = {{"energy.drift", 1e-14}};
  Sample sample;
  sample.asked = 0.5;
  sample.time = 0.498;
  sample.errors = {{"stress", 0.497, 1e6, 0.01, 0.02, 0.3, {}, 0.019, {}}};
  sample.probes = {{"gauge", 3.5, 3.25}};
  sample.curves["stress"] = {{0, 1}, {2, 3}};
  run.samples = {sample};
  data.runs = {run};
  Gate good;
  good.case_id = data.id;
  good.id = "stress-L2";
  good.verdict = Verdict::pass;
  good.checks = {{"N=200", 0.02, 0.019, 0.98, 1.02, 1.0, true}};
  Gate bad = good;
  bad.id = "order";
  bad.verdict = Verdict::fail;
  bad.message = "slope 0.2 < 0.4 & falling\x01";
  bad.checks = {{"fit", 0.2, {}, 0.4, 0.6, 0.2, false}};
  bad.line = 17;
  Gate blown = bad, unjudged = bad, broken = bad;
  blown.id = "limit";
  blown.verdict = Verdict::unstable;
  blown.checks[0].value = blown.checks[0].judged = not_a_number;
  unjudged.id = "late";
  unjudged.verdict = Verdict::invalid;
  unjudged.checks.clear();
  broken.id = "crash";
  broken.verdict = Verdict::error;
  data.gates = {good, bad, blown, unjudged, broken};
  return data;
}

}  // namespace

BOOST_AUTO_TEST_CASE(writes_and_replaces) {
  const Folder folder;
  const fs::path path = folder.path / "new" / "deep" / "results.txt";
  write_file(path, "one");
  BOOST_TEST(contents(path) == "one");
  ::chmod(path.c_str(), 0600);
  const std::string large(3000000, 'x');
  write_file(path, large);
  BOOST_TEST((contents(path) == large));
  BOOST_TEST((fs::status(path).permissions() == fs::perms(0600)));
  write_file(path, "");
  BOOST_TEST(fs::file_size(path) == 0U);
  fs::create_symlink(path, folder.path / "link");
  write_file(folder.path / "link", "through");
  BOOST_TEST(fs::is_symlink(folder.path / "link"));
  BOOST_TEST(contents(path) == "through");
  BOOST_TEST(folder.entries() == 2U);
}

BOOST_AUTO_TEST_CASE(full_disk_keeps_the_old_file) {
  const Folder folder;
  const fs::path path = folder.path / "results.txt";
  write_file(path, "good");
  {
    const FullDisk full(1000);
    BOOST_CHECK_EXCEPTION(write_file(path, std::string(5000, 'x')), std::runtime_error,
                          says({path.string(), "File too large"}));
    BOOST_CHECK_EXCEPTION(write_file(folder.path / "other.txt", std::string(5000, 'x')), std::runtime_error,
                          says({"other.txt", "File too large"}));
  }
  BOOST_TEST(contents(path) == "good");
  BOOST_TEST(folder.entries() == 1U);  // neither a temporary nor a half-written file
}

BOOST_AUTO_TEST_CASE(devices_are_written_to_not_replaced) {
  if (!fs::is_character_file("/dev/full")) {
    BOOST_TEST_MESSAGE("no /dev/full here");
    return;
  }
  BOOST_CHECK_EXCEPTION(write_file("/dev/full", "x"), std::runtime_error,
                        says({"/dev/full", "No space left on device"}));
  BOOST_TEST(fs::is_character_file("/dev/full"));
  write_file("/dev/null", "x");
  BOOST_TEST(fs::is_character_file("/dev/null"));
}

BOOST_AUTO_TEST_CASE(impossible_places) {
  const Folder folder;
  write_file(folder.path / "file", "x");
  BOOST_CHECK_EXCEPTION(write_file(folder.path / "file" / "below", "y"), std::runtime_error,
                        says({"file/below", "Not a directory"}));
  BOOST_CHECK_EXCEPTION(write_file(folder.path, "y"), std::runtime_error, says({folder.path.string(), "directory"}));
  BOOST_CHECK_THROW(write_file("", "y"), std::runtime_error);
  BOOST_TEST(contents(folder.path / "file") == "x");
  if (::geteuid() != 0) {  // root may write anywhere
    fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
    BOOST_CHECK_EXCEPTION(write_file(folder.path / "new", "y"), std::runtime_error, says({"new", "Permission denied"}));
    fs::permissions(folder.path, fs::perms::owner_all);
  }
  BOOST_TEST(folder.entries() == 1U);
}

BOOST_AUTO_TEST_CASE(jsonl_reads_back) {
  const Provenance made_by{"1.0", "abc123", "g++ 12", "-O3", "GSL 2.7", "CPU", "Linux", true};
  const auto lines = parsed(results_jsonl({example()}, made_by));
  BOOST_TEST_REQUIRE(lines.size() == 6U);
  const auto& run = lines[0];
  BOOST_TEST(run["type"] == "run");
  BOOST_TEST(run["case"] == "bar <1>");
  BOOST_TEST(run["label"] == "mpm-usf N=200 C=0 ppc=1 v0=0.1");
  BOOST_TEST(run["parameters"] == "v0=0.1");
  BOOST_TEST(run["courant"].get<double>() == 0.1 + 0.2);
  BOOST_TEST(run["particle_steps"].get<long>() == 5000000000);
  BOOST_TEST(run["finite"] == true);
  BOOST_TEST(run["features"] == nlohmann::json({"elastic", "viscosity"}));
  BOOST_TEST(run["measures"]["energy.drift"].get<double>() == 1e-14);
  BOOST_TEST_REQUIRE(run["samples"].is_array());
  const auto& error = run["samples"][0]["errors"][0];
  BOOST_TEST(error["field"] == "stress");
  BOOST_TEST(error["time"].get<double>() == 0.497);
  BOOST_TEST(error["predicted_l2"].get<double>() == 0.019);
  BOOST_TEST(!error.contains("predicted_l1"));
  BOOST_TEST(run["samples"][0]["probes"][0]["id"] == "gauge");
  BOOST_TEST(!run["samples"][0].contains("curves"));
  BOOST_TEST(run["env"]["commit"] == "abc123");
  BOOST_TEST(run["env"]["dirty"] == true);
  BOOST_TEST(lines[1]["type"] == "gate");
  BOOST_TEST(lines[1]["verdict"] == "PASS");
  BOOST_TEST(lines[1]["checks"][0]["what"] == "N=200");
  BOOST_TEST(lines[1]["checks"][0]["passed"] == true);
  BOOST_TEST(lines[2]["line"] == 17);
}

BOOST_AUTO_TEST_CASE(jsonl_says_what_is_not_finite) {
  Case data = example();
  data.runs[0].samples[0].errors[0].l2 = not_a_number;
  data.runs[0].message = "caf\xe9";  // not UTF-8
  const auto lines = parsed(results_jsonl({data}, {}));
  const auto& run = lines[0];
  BOOST_TEST(run["finite"] == false);
  BOOST_TEST(run["samples"][0]["finite"] == false);
  BOOST_TEST(run["samples"][0]["errors"][0]["finite"] == false);
  BOOST_TEST(run["samples"][0]["errors"][0]["l2"].is_null());
  BOOST_TEST(run["samples"][0]["errors"][0]["l1"].get<double>() == 0.01);
  BOOST_TEST(run["samples"][0]["probes"][0]["finite"] == true);
  BOOST_TEST(lines[3]["checks"][0]["judged"].is_null());
  BOOST_TEST(lines[3]["checks"][0]["finite"] == false);
  BOOST_TEST(lines[3]["finite"] == false);
  data = example();
  data.runs[0].finite = false;
  BOOST_TEST(parsed(results_jsonl({data}, {}))[0]["finite"] == false);
  data = example();
  data.runs[0].measures["bits.mirror"] = not_a_number;
  BOOST_TEST(parsed(results_jsonl({data}, {}))[0]["measures"]["bits.mirror"].is_null());
  BOOST_TEST(parsed(results_jsonl({data}, {}))[0]["finite"] == false);
}

BOOST_AUTO_TEST_CASE(junit_reads_back) {
  const std::string xml = junit_xml({example(), Case{}});
  pugi::xml_document document;
  BOOST_TEST_REQUIRE(document.load_string(xml.c_str()));
  const auto root = document.child("testsuites");
  BOOST_TEST(root.attribute("tests").as_int() == 5);
  BOOST_TEST(root.attribute("failures").as_int() == 1);
  BOOST_TEST(root.attribute("errors").as_int() == 3);
  const auto suite = root.child("testsuite");
  BOOST_TEST(suite.attribute("name").value() == std::string("bar <1>"));
  std::vector<pugi::xml_node> tests(suite.children("testcase").begin(), suite.children("testcase").end());
  BOOST_TEST_REQUIRE(tests.size() == 5U);
  BOOST_TEST(tests[0].attribute("name").value() == std::string("stress-L2"));
  BOOST_TEST(tests[0].attribute("classname").value() == std::string("bar <1>"));
  BOOST_TEST(!tests[0].first_child());
  const auto failure = tests[1].child("failure");
  BOOST_TEST(failure.attribute("message").value() == std::string("slope 0.2 < 0.4 & falling?"));
  BOOST_TEST(holds(failure.text().get(), "judged 0.2 in [0.4, 0.6]"));
  BOOST_TEST(tests[2].child("error").attribute("type").value() == std::string("UNSTABLE"));
  BOOST_TEST(holds(tests[2].child("error").text().get(), "judged nan"));
  BOOST_TEST(tests[3].child("error").attribute("type").value() == std::string("INVALID"));
  BOOST_TEST(tests[4].child("error").attribute("type").value() == std::string("ERROR"));
}

BOOST_AUTO_TEST_SUITE_END()
