#include "addons/fleet/jobs/job_worker.hpp"

#include <chrono>
#include <cstdlib>

#include <fmt/format.h>

#include "addons/fleet/jobs/contents.hpp"
#include "addons/fleet/jobs/piece_process.hpp"
#include "addons/fleet/store/schema.hpp"
#include "spoolflow/parallel/pace.hpp"

namespace spoolflow::fleet {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds asks_every{500};
constexpr std::chrono::seconds takes_up_again_after{1};
constexpr std::chrono::minutes cleans_every{5};

Outcome failed(const std::string& message) {
  return {.status = 1, .messages = {message}};
}

}  // namespace

JobWorker::JobWorker(JobWorkerParts parts, std::function<void(const std::string&)> report)
    : parts_(std::move(parts)), report_(std::move(report)) {
  remove_abandoned_folders();
  for (unsigned k = 0; k < parts_.settings.processes; ++k)
    threads_.emplace_back([this, k](const std::stop_token& stop) { work(stop, k == 0); });
}

void JobWorker::stop() {
  for (std::jthread& thread : threads_) thread.request_stop();
  threads_.clear();
}

void JobWorker::work(const std::stop_token& stop, bool cleans_up) {
  std::unique_ptr<Session> session;
  Clock::time_point cleaned{};
  std::string reported;
  while (!stop.stop_requested()) {
    try {
      if (!session) {
        session = std::make_unique<Session>(parts_.connection, parts_.owner);
        (void)read_settings(*session);
      }
      if (cleans_up && Clock::now() - cleaned > cleans_every) {
        remove_old_jobs(*session, parts_.settings.keep_hours);
        cleaned = Clock::now();
      }
      report_at_work(*session, parts_.owner, parts_.program);
      if (!take_one(session, stop)) parallel::wait_for(asks_every, stop);
      reported.clear();
    } catch (const ServerAway&) {  // the worker reports it as a whole
      session.reset();
      parallel::wait_for(takes_up_again_after, stop);
    } catch (const std::exception& error) {
      session.reset();
      if (reported != error.what()) report_(error.what());
      reported = error.what();
      parallel::wait_for(takes_up_again_after, stop);
    }
  }
}

bool JobWorker::take_one(std::unique_ptr<Session>& session, const std::stop_token& stop) {
  const auto job = take_job(*session, parts_.owner, parts_.program, parts_.lease_s);
  if (!job) return false;
  const PieceFolder folder;
  try {
    parts_.write(folder.path() / piece_name, job->manifest);
    for (const PieceFile& file : read_piece(job->manifest).files) {
      parts_.write(folder.path() / file.name, content_of(*session, file));
      (void)renew_job(*session, job->key, parts_.owner, parts_.lease_s);
    }
  } catch (const PieceError& error) {
    finish_job(*session, {job->key, JobState::failed, text_of(failed(error.what()))}, {});
    return true;
  } catch (const std::runtime_error&) {
    if (session) return_job(*session, job->key, parts_.owner, false);  // this machine's fault: others may have it
    throw;
  }
  const int ended = run_piece_process(folder.path(), [&] { return goes_on(session, job->key, stop); });
  if (!session) session = std::make_unique<Session>(parts_.connection, parts_.owner);
  if (std::filesystem::exists(folder.path() / outcome_name)) {
    finish(*session, job->key, folder.path());
  } else {
    return_job(*session, job->key, parts_.owner, !stop.stop_requested());
    if (!stop.stop_requested())
      report_(fmt::format("the piece {:.8} ended without a result ({} {})", job->key,
                          ended < 0 ? "signal" : "exit status", std::abs(ended)));
  }
  return true;
}

/// What is done while the database is away is not lost: any worker that has the piece then makes the same result.
bool JobWorker::goes_on(std::unique_ptr<Session>& session, const std::string& key, const std::stop_token& stop) {
  if (stop.stop_requested()) return false;
  try {
    if (!session) session = std::make_unique<Session>(parts_.connection, parts_.owner);
    report_at_work(*session, parts_.owner, parts_.program);
    return renew_job(*session, key, parts_.owner, parts_.lease_s);
  } catch (const ServerAway&) {
    session.reset();
    return true;
  }
}

void JobWorker::finish(Session& session, const std::string& key, const std::filesystem::path& folder) {
  Outcome outcome = read_outcome(whole_file(folder / outcome_name));
  std::vector<std::string> contents;
  for (PieceFile& file : outcome.files) {
    const double written_MB = 1e-6 * static_cast<double>(std::filesystem::file_size(folder / file.name));
    if (written_MB > parts_.settings.largest_MB) {
      finish_job(session, {key, JobState::failed, text_of(failed(too_large(file.name, written_MB, parts_.settings)))},
                 {});
      return;
    }
    file = keep(session, file.name, whole_file(folder / file.name));
    contents.push_back(file.sha256);
  }
  finish_job(session, {key, outcome.status == 1 ? JobState::failed : JobState::done, text_of(outcome)}, contents);
}

std::string too_large(const std::string& file, double bytes_MB, const JobSettings& settings) {
  return fmt::format(
      "{}: has {:.0f} MB; a file of batch work may have {:.0f} MB ([jobs] largest_MB in the fleet file); do "
      "the work here, without --fleet, or cut the recording",
      file, bytes_MB, settings.largest_MB);
}

}  // namespace spoolflow::fleet
