// THE table of kinds of moves of a Markov chain: what they are called.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace trace {

/// The numbers of a sample: changed a little. All is replaced. The others change a path place by place.
enum class MoveKind { nearby, anywhere, bidirectional, lens, caustic, multiChain };

struct MoveLook {
  std::string_view name;  ///< name of a column
  std::string_view of;    ///< "12 of 70 moves ..."
};
inline constexpr std::array<MoveLook, 6> kMoveLooks{{{"nearby", "nearby"},
                                                     {"anywhere", "anywhere"},
                                                     {"bidirectional", "bidirectional"},
                                                     {"lens", "of the lens"},
                                                     {"caustic", "of a caustic"},
                                                     {"multi-chain", "of many chains"}}};
inline constexpr std::size_t kMoveKinds = kMoveLooks.size();

constexpr const MoveLook& look(MoveKind kind) { return kMoveLooks[static_cast<std::size_t>(kind)]; }

}  // namespace trace
