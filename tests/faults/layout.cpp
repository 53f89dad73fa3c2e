// Where in the firmware's memory what lies: the lines of a table in a section of their own, which
// tests/faults/places.py reads and adds to the addresses of the image. Compiled without access
// control, since most of it is private.
#include <array>
#include <cstddef>
#include <cstdint>

#include "app/loop.hpp"
#include "board.hpp"
#include "car_block/car_block.hpp"
#include "firmware_grids.hpp"
#include "peripherals.hpp"

namespace {

using iog::imx6::Board;
using iog::imx6::EnetMemory;
using iog::imx6::GptClock;
using Platform = iog::app::MachinePlatform<Board>;
using Pipeline = iog::app::MachinePipeline<Board, iog::imx6::kGrids>;
using Perception = iog::app::PerceptionEngine;
using Frame = iog::app::Frame;
using Fusion = iog::fusion::SharedFusion;
using Clock = iog::perception::WindowClock;
using iog::health::MemoryCheck;

struct Line {
  std::array<char, 24> kind;
  std::array<char, 40> object;  // a symbol of the image
  std::uint32_t offset;
  std::uint32_t bytes;
};

constexpr std::uint32_t kPerception = offsetof(Pipeline, perception_);
constexpr std::uint32_t kFrame = offsetof(Pipeline, frame_);

// A macro, because a member's name is no value.
#define IOG_LINE(kind, object, base, type, member) \
  Line { {kind}, {object}, (base) + offsetof(type, member), sizeof(type::member) }
#define IOG_OF_PERCEPTION(kind, member) \
  IOG_LINE(kind, "main::pipeline", kPerception, Perception, member)
#define IOG_OF_FRAME(kind, member) IOG_LINE(kind, "main::pipeline", kFrame, Frame, member)
#define IOG_OF_FUSION(kind, member) \
  IOG_LINE(kind, "main::pipeline", kFrame + offsetof(Frame, fusion_), Fusion, member)
#define IOG_OF_DMA(kind, member) IOG_LINE(kind, "iog::imx6::enet_memory", 0, EnetMemory, member)
// Those that the loop uses. Of the GIC QEMU asks which core reads it, and ends if none does.
#define IOG_DEVICE(object, type) \
  Line { {"device registers"}, {object}, 0, sizeof(iog::imx6::type) }

[[gnu::used, gnu::section("layout")]] constexpr std::array kLayout = {
    IOG_LINE("index grids", "main::pipeline", 0, Pipeline, helpers_),
    IOG_OF_FUSION("index grids", own_),
    IOG_OF_FUSION("index grids", joined_),
    IOG_OF_FUSION("index grids", grounds_),
    IOG_OF_PERCEPTION("index grids", fused_),
    IOG_OF_PERCEPTION("class planes", window_),
    IOG_OF_PERCEPTION("objects", follower_),
    IOG_OF_FUSION("intake", packets_),
    IOG_OF_FRAME("intake", intake_),
    IOG_OF_FRAME("intake", watched_),
    IOG_OF_PERCEPTION("intake", slices_),
    IOG_OF_PERCEPTION("intake", receptions_),
    IOG_OF_PERCEPTION("poses", poses_),
    IOG_OF_PERCEPTION("map", maps_),
    IOG_OF_PERCEPTION("map", layer_),
    // From there on to its end: the vehicle, the window's clock, what is asked of the frame at
    // hand.
    Line{{"frame and its place"},
         {"main::pipeline"},
         kPerception + offsetof(Perception, vehicle_),
         sizeof(Perception) - offsetof(Perception, vehicle_)},
    Line{{"made of the car"}, {"main::sensors"}, 0, sizeof(iog::car_block::SensorMemory)},
    Line{{"made of the car"}, {"main::car"}, 0, sizeof(iog::vehicle::Vehicle)},
    IOG_LINE("stream", "main::pipeline", 0, Pipeline, network_),
    Line{{"network and team"}, {"main::platform"}, 0, sizeof(Platform)},
    Line{{"drivers"}, {"main::board"}, 0, sizeof(Board)},
    IOG_OF_DMA("receive descriptors", receive_descriptors),
    IOG_OF_DMA("transmit descriptors", transmit_descriptors),
    IOG_OF_DMA("receive buffers", receive_buffers),
    IOG_OF_DMA("transmit buffers", transmit_buffers),
    IOG_DEVICE("enet", EnetRegisters),
    IOG_DEVICE("gpt", GptRegisters),
    IOG_DEVICE("epit1", EpitRegisters),
    IOG_DEVICE("uart2", UartRegisters),
    IOG_DEVICE("wdog1", WatchdogRegisters),
    // Nothing is drawn of these: tests/soak sets them before a drive begins, or looks at them.
    IOG_LINE("wraps of the clock", "main::board", offsetof(Board, clock_), GptClock, wraps_),
    IOG_LINE("frame number", "main::pipeline", kFrame, Frame, number_),
    IOG_LINE("time beside the poses'", "main::pipeline", kPerception + offsetof(Perception, clock_),
             Clock, offset_us_),
    IOG_LINE("rounds of the check", "main::check", 0, MemoryCheck, rounds_),
};

// tests/soak/watched_machine.py looks at it.
static_assert(offsetof(iog::app::Backlog, is_busy_) == 0);

}  // namespace
