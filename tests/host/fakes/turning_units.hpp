// Every unit that turns and a car of vehicles/ that has it, with what its maker says of its
// packets. Who adds a unit adds a row; TurningUnits.EveryFormatAndEveryCarHasARow fails until then.
#pragma once

#include <array>
#include <cstdint>

namespace iog::tests {

struct TurningUnit {
  const char* car;
  double packets_per_second;       // with one return, by the unit's manual
  std::uint32_t moving_drive_crc;  // of the simulator's bytes, pinned
};

inline constexpr std::array<TurningUnit, 16> kTurningUnits{{
    {.car = "roof_hdl32e", .packets_per_second = 1'808.45, .moving_drive_crc = 0x3206BF2E},
    {.car = "roof_hdl64e", .packets_per_second = 2'893.52, .moving_drive_crc = 0xBAE1971E},
    {.car = "roof_os0_128", .packets_per_second = 640.0, .moving_drive_crc = 0xBFF4982F},
    {.car = "roof_os0_32_dual", .packets_per_second = 640.0, .moving_drive_crc = 0x047510C9},
    {.car = "roof_os1_64", .packets_per_second = 640.0, .moving_drive_crc = 0x08125937},
    {.car = "roof_pandar40p", .packets_per_second = 1'800.0, .moving_drive_crc = 0x93C94493},
    {.car = "roof_pandar64", .packets_per_second = 3'000.0, .moving_drive_crc = 0xE3381934},
    {.car = "roof_puck_hires", .packets_per_second = 753.52, .moving_drive_crc = 0xF2BB9728},
    {.car = "roof_qt128", .packets_per_second = 4'500.0, .moving_drive_crc = 0xA6515580},
    {.car = "roof_qt64", .packets_per_second = 1'500.0, .moving_drive_crc = 0x0C2B2E8D},
    {.car = "roof_vlp16", .packets_per_second = 753.52, .moving_drive_crc = 0xFAD9F560},
    {.car = "roof_vlp32c", .packets_per_second = 1'507.04, .moving_drive_crc = 0x48338338},
    {.car = "roof_vls128", .packets_per_second = 6'029.91, .moving_drive_crc = 0xAA6506CE},
    {.car = "roof_xt16", .packets_per_second = 2'500.0, .moving_drive_crc = 0xD5A9A5D9},
    {.car = "roof_xt32", .packets_per_second = 2'500.0, .moving_drive_crc = 0xA6EF2BBB},
    {.car = "roof_xt32m", .packets_per_second = 3'333.33, .moving_drive_crc = 0x3A6B6F88},
}};

}  // namespace iog::tests
