#pragma once

#include "runs/pilot.hpp"

#include <limits>
#include <string>
#include <vector>

namespace skein {

/// What a run can be asked for, and compared by.
enum class Question {
  shape,          ///< largest distance between centrelines at the same time and place along the fiber, over its length
  half_period,    ///< of each half turn, relative
  hook_radius,    ///< relative
  snaking_speed,  ///< relative
  curvature_max,  ///< over the whole run, relative
  contact,        ///< how deep surfaces are pressed into each other, difference over the radius
};
const std::vector<Question>& list_questions();
const char* name_of(Question question);
/// @throws Error(usage) naming the ones there are
Question find_question(const std::string& name);

/// How far one run's answer is from a better one's.
struct AnswerError {
  Question question;
  double error = 0.0;  ///< infinite where only one of the runs has an answer, and where fibers have crossed
};

/// Of the worst fiber each, over the time that both runs reached; questions that neither run answers are left out.
/// @param better  of the same fibers with whatever nodes, and the same frames as far as both go
std::vector<AnswerError> compare_answers(const Pilot& run, const Pilot& better, const std::vector<Question>& asked);

/// The largest of them; 0 for none. @param worst  which, if not null
double find_largest_error(const std::vector<AnswerError>& errors, Question* worst = nullptr);

}  // namespace skein
