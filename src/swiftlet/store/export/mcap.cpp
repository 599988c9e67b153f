// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <array>
#include <memory>
#include <utility>

#include "swiftlet/bag/byte_sink.hpp"
#include "swiftlet/bag/mcap/mcap_writer.hpp"
#include "swiftlet/bag/messages/message_definitions.hpp"
#include "swiftlet/bag/messages/ros2_messages.hpp"
#include "swiftlet/file/output_file.hpp"
#include "swiftlet/store/export/exporters.hpp"
#include "swiftlet/store/export/far_points.hpp"
#include "swiftlet/store/export/reported_voxels.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kFrame = "map";

/// The file tells at its end, in commit(), what could not be written.
class OutputSink final : public ByteSink {
 public:
  explicit OutputSink(OutputFile& file) : file_(file) {}
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override {
    file_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return Done{};
  }

 private:
  OutputFile& file_;
};

Status write_cloud(McapWriter& writer, const ros2::VoxelCloud& cloud) {
  const auto topic = writer.add_topic("/map/occupied", "sensor_msgs/msg/PointCloud2", "ros2msg",
                                      message_definition("sensor_msgs/PointCloud2"), "cdr");
  return writer.write(topic, Stamp{}, cloud.message({Stamp{}, kFrame}));
}

}  // namespace

/// Memory: that of the cloud, 13 bytes a voxel.
Status export_mcap(const SavedMap& map, const std::filesystem::path& out,
                   const ExportProgress& progress) {
  auto summary = summarize(map);
  if (!summary) return forward_error(std::move(summary));
  auto file = OutputFile::create(out, std::array{map.path()});
  if (!file) return forward_error(std::move(file));
  auto writer = McapWriter::create(std::make_unique<OutputSink>(*file), {});
  if (!writer) return forward_error(std::move(writer));
  ros2::VoxelCloud cloud("log_odds", !floats_suffice(summary->bounds));
  auto passed = for_each_known_voxel(
      map, progress, [&](const VoxelIndex& v, QuantizedLogOdds voxel, Occupancy state) {
        if (state == Occupancy::kOccupied) cloud.add(centre_of(v, map.voxel_m()), voxel);
      });
  if (!passed) return passed;
  McapWriter::Metadata words(map.meta().begin(), map.meta().end());
  if (auto written = writer->write_metadata("swiftlet map", words); !written) return written;
  if (auto written = write_cloud(*writer, cloud); !written) return written;
  if (auto closed = writer->close(); !closed) return closed;
  return file->commit();
}

}  // namespace swiftlet
