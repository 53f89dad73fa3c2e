// Whose capture this is: which units send what comes to each port, and which vehicle's sensors they
// are. Vehicles may share UDP ports, and a recording of another one is fused without a complaint:
// each packet is sound. So what comes is compared with what each vehicle's sensors would send: on
// which ports, of which unit, and, of LUX, how far apart their directions are.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/identity/unit_watch.hpp"
#include "tools/vehicles/named_senders.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

class CaptureIdentity {
 public:
  // A datagram of the capture, of whatever port.
  void add(const CapturedDatagram& datagram);

  // Whether more of the capture would hardly tell more of the car's sensors.
  [[nodiscard]] bool is_settled(const CatalogueEntry& car) const;

  // What of the packets is not as the vehicle's sensors would send them, one reason each; nothing
  // if all of it is.
  [[nodiscard]] std::vector<std::string> misfits(const CatalogueEntry& car) const;

  // Among vehicles with a sending sensor, the one with the fewest misfits, preferably on the car's
  // ports. nullptr if none has fewer than the car.
  [[nodiscard]] const CatalogueEntry* better_than(const CatalogueEntry& car) const;

  // "the packets look like those of two_lux_parking: no scan comes to UDP port 12004; ..."; empty
  // if no vehicle fits better than the car.
  [[nodiscard]] std::string words(const CatalogueEntry& car) const;

  // "no packet comes to UDP port 2370, but scans come to 2369: ..."; empty unless a sensor of the
  // car is silent and scans come to a port that none of them has.
  [[nodiscard]] std::string words_of_wrong_port(const CatalogueEntry& car) const;

  // That several units send at the same time to a port of a sensor whose address in the car's file
  // is none of theirs; empty if none do. A unit whose address changes is one.
  [[nodiscard]] std::string words_of_crowd(const CatalogueEntry& car) const;

  // The vehicles that fit best, and what does not fit even them; empty if nothing of a lidar has
  // come.
  [[nodiscard]] std::string words_of_best() const;

  // Why the capture cannot be the car's, and which vehicle's it is; empty if it may be. What is of
  // no lidar that is known is left to the decoders.
  [[nodiscard]] std::string refusal(const CatalogueEntry& car) const;

 private:
  static constexpr std::size_t kNamedPorts = 8;  // more would hide what matters

  // What has come from one sender to one port.
  struct Sender {
    std::uint64_t datagrams = 0;
    UnitWatch watch;
  };
  // What has come to a port.
  struct Port {
    std::uint64_t datagrams = 0;
    std::map<std::uint32_t, Sender> senders;  // by source, the first 64
    std::uint64_t of_others = 0;              // datagrams of further sources
    // Certain units, with the reason if all packets of a supported one are refused; else empty.
    std::map<std::string, std::string_view> names;
    std::string doubted;  // of the last one that is in doubt
    lidar::FormatSet doubted_formats;
    bool has_ours = false;  // of a unit that iogrid takes
    // Those that would send what came, of any vehicle, and from which sources it came.
    std::map<const vehicle::Sensor*, std::map<std::uint32_t, Heard>> its_senders;
    // How often two neighbouring directions of a message were so many ticks apart.
    std::map<std::int32_t, std::uint64_t> steps;

    [[nodiscard]] bool is_of_lidar() const { return !names.empty() || !doubted.empty(); }
    // "UDP port 2368 receives a Velodyne VLP-16"
    [[nodiscard]] std::string words(std::uint16_t number) const;
  };

  struct Misfit {
    enum class Kind : std::uint8_t {
      kNone,
      kSilent,   // nothing comes from the sensor, or from one that the vehicle does not have
      kCoarser,  // directions are farther apart
      kFiner,    // nearer together
      kInDoubt,  // of two units it may be either
      kRefused,  // of this unit, but all packets are refused
      kOther,    // of another unit
    };
    Kind kind = Kind::kNone;
    std::string words{};
  };

  static void note_directions(std::span<const std::byte> scan, Port& port);
  [[nodiscard]] Misfit misfit_of(const CatalogueEntry& car, std::size_t sensor) const;
  [[nodiscard]] std::vector<Misfit> all_misfits(const CatalogueEntry& car) const;
  // Whether anything is of a unit that iogrid takes.
  [[nodiscard]] bool has_ours() const;
  // Whether anything is of one of the car's sensors.
  [[nodiscard]] bool has_sender(const CatalogueEntry& car) const;
  // All that are as better_than() says.
  [[nodiscard]] std::vector<const CatalogueEntry*> better_ones(const CatalogueEntry& car) const;
  [[nodiscard]] bool has_sender_on_ports_of(const CatalogueEntry& other,
                                            const CatalogueEntry& car) const;
  [[nodiscard]] std::string words_of_ports() const;
  [[nodiscard]] std::string words_without_packet_for(const CatalogueEntry& car) const;
  [[nodiscard]] std::string advice(const CatalogueEntry& car) const;

  std::map<std::uint16_t, Port> ports_;
  std::uint64_t datagrams_ = 0;
};

// Reads as much of the captures as tells whose they are. UsageError with CaptureIdentity::refusal()
// if they cannot be the car's, or if a file cannot be read. If one is no regular file, such as a
// pipe, it could be read only once and all are left alone.
void demand_fit(const std::vector<std::string>& paths, const CatalogueEntry& car);

}  // namespace iog::tools
