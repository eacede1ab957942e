#include "spoolflow/apps/work/analysed_run.hpp"

#include <utility>

#include <fmt/format.h>

#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::apps {

using recording::Channel;

AnalysedRun read_analysed_run(const model::Model& model, const std::string& file, recording::ChannelMap channels) {
  recording::ReadOptions options = estimation::sensor_channels(model, std::move(channels));
  for (const Channel channel : {Channel::flow_reference, Channel::flow, Channel::current_a, Channel::current_b})
    options.optional.push_back(channel);
  options.stands_in = {{Channel::current, Channel::current_b}};  // so that a whole valve's run is recognised
  const recording::Recording run = recording::read_recording(file, options);
  if (run.column(Channel::current_a).empty() && run.column(Channel::current_b).empty())
    return {analysis::run_samples(run), run.resampled};
  throw recording::RecordingError(fmt::format(
      "{}: is a run of a whole valve (current_a, current_b); a budget is made up along a run of one direction, "
      "with one current and positions >= 0. Give such a run, or leave it out",
      file));
}

}  // namespace spoolflow::apps
