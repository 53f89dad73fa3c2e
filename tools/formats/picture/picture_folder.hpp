// A folder of pictures and ROS maps of one run: what an earlier run of iog has left there would
// look like this one's, and what others have put there is theirs.
#pragma once

#include <string>

namespace iog::tools {

class PictureFolder {
 public:
  // Makes the folder. with_maps: numbered maps, too. UsageError if a file there has the name of one
  // that clear() removes or that a run writes, and iog did not write it.
  PictureFolder(std::string path, bool with_maps);

  [[nodiscard]] const std::string& path() const { return path_; }

  // Removes the numbered files of an earlier run. UsageError as above.
  void clear() const;

 private:
  std::string path_;
  bool with_maps_;
};

}  // namespace iog::tools
