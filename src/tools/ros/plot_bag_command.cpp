#include <filesystem>
#include <iostream>
#include <memory>
#include <set>

#include <rosbag/view.h>

#include "cycle_report.h"
#include "ros/bag/read_bag.h"
#include "tools/commands.h"
#include "tools/progress_bar.h"

namespace sdf_ccd::tools {
namespace {

struct PlotBagArguments {
  std::string bag;
  std::string out;
  std::string topic;
};

std::string topicOf(const rosbag::Bag& bag, const PlotBagArguments& arguments) {
  rosbag::View view(bag);
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    if (connection->datatype != "sdf_ccd/ContactArray") continue;
    topics.insert(connection->topic);
    if (arguments.topic.empty() || arguments.topic == connection->topic) {
      requireDefinition<ContactArray>(*connection, arguments.bag,
                                      "it was recorded with another version of sdf_ccd: plot it with that one, or make "
                                      "new contacts from its transforms with `sdf_ccd check-bag`");
    }
  }
  if (topics.empty()) throw std::runtime_error(arguments.bag + ": contains no sdf_ccd/ContactArray");
  if (arguments.topic.empty() && topics.size() > 1) {
    throw std::runtime_error(arguments.bag + ": holds contacts on " + *topics.begin() + " and others: use --topic");
  }
  const std::string& topic = arguments.topic.empty() ? *topics.begin() : arguments.topic;
  if (topics.count(topic) == 0) throw std::runtime_error(arguments.bag + ": contains no contacts on " + topic);
  return topic;
}

/// Adds all messages of the topic to the report.
void addAll(const rosbag::Bag& bag, const std::string& topic, CycleReport& report) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  ProgressBar bar("contacts");
  std::size_t count = 0;
  for (const rosbag::MessageInstance& message : view) {
    bar(double(++count) / double(view.size()));
    const auto contacts = messageOf<ContactArray>(message);
    if (!contacts) throw std::runtime_error(topic + " holds messages of other types, too");
    report.add(*contacts);
  }
}

void run(const PlotBagArguments& arguments) {
  readBag(arguments.bag, [&] {
    rosbag::Bag bag(arguments.bag);
    const std::string topic = topicOf(bag, arguments);
    OutputDirectory out(arguments.out);
    CycleReport report(out);
    addAll(bag, topic, report);
    const ros::Time begin = rosbag::View(bag).getBeginTime();  // as for check-bag, and other tools for bags
    std::cout << "bag              " << arguments.bag << ": from " << timeText(begin) << "\n"
              << report.statistics().summary(begin) << std::flush;
    if (report.commit(begin, "Error and run time of " + topic + " in " +
                                 std::filesystem::path(arguments.bag).filename().string())) {
      return;
    }
    std::cerr << "sdf_ccd: no error_time.svg: gnuplot is missing or failed, or no cycle has a bound" << std::endl;
    throw PartlyDone();
  });
}

}  // namespace

void addPlotBagCommand(CLI::App& app) {
  auto arguments = std::make_shared<PlotBagArguments>();
  CLI::App* command =
      app.add_subcommand("plot-bag", "Error bound against run time of a monitor whose contacts were recorded");
  command->footer(
      "Every cycle's message carries its error bound and run time. Writes to DIR: error_time.svg (gnuplot), cycles.csv "
      "(a row per cycle), contacts.csv (a row per pair and contact, over however many cycles it lasts). Times are "
      "seconds, lengths metres. Exit code 1: no plot, as gnuplot is not installed or failed, or no cycle has a bound.");
  command->add_option("bag", arguments->bag, "Bag with contacts of the monitor, or of check-bag")->required();
  command->add_option("--out", arguments->out, "Directory to write to; made if it is missing")->required();
  command->add_option("--topic", arguments->topic, "Topic of the contacts; default the only one");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sdf_ccd::tools
