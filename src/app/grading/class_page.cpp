// The page and the CSV file of a class: students by scenes. The picture of a reference stands in the page
// once, as the background of its column; only pictures that fail are stored besides.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/compare/html.h"
#include "app/grading/class_grade.h"
#include "base/text.h"

namespace trace {
namespace {

constexpr std::string_view kClassStyle = R"css(
* { box-sizing: border-box; }
 body { margin: 0; padding: 1.5rem; background: var(--ground); color: var(--ink); font: 14px/1.35 system-ui, sans-serif; }
 h1 { font-size: 1.4rem; margin: 0 0 .3rem; }
 p { margin: .2rem 0; } .faint { color: var(--faint); } .bad { color: var(--bad); } .good { color: var(--good); }
 table { border-collapse: collapse; margin-top: 1rem; background: var(--card); }
 thead { position: sticky; top: 0; background: var(--card); z-index: 1; }
 th, td { border-bottom: 1px solid var(--line); padding: .3rem .4rem; text-align: left; vertical-align: top; }
 tbody th { position: sticky; left: 0; background: var(--card); }
 td.points { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
 img, .same { display: block; height: 60px; width: auto; background-size: contain; background-repeat: no-repeat; }
 td img, .same { cursor: zoom-in; } .same { min-width: 60px; width: 100%; opacity: .55; border: 0; background-color: transparent; }
 td > span { display: block; max-width: 11rem; }
 dialog { border: 1px solid var(--line); border-radius: .6rem; background: var(--card); color: var(--ink); max-width: 96vw; }
 dialog::backdrop { background: #000a; } dialog img { height: auto; width: 360px; max-width: 30vw; image-rendering: pixelated; }
 img[hidden] { display: none; }
.three { display: flex; flex-wrap: wrap; gap: 1rem; } figure { margin: 0; } figcaption { color: var(--faint); }
 pre { white-space: pre-wrap; } button { font: inherit; }
)css";

constexpr std::string_view kClassScript = R"js(
'use strict';
const dialog = document.querySelector('dialog');
document.querySelector('table').onclick = event => {
  const cell = event.target.closest('td[data-title]');
  if (!cell) return;
  dialog.querySelector('h2').textContent = cell.dataset.title;
  dialog.querySelector('pre').textContent = cell.dataset.text;
  const column = document.querySelectorAll('thead th')[cell.cellIndex];
  const pictures = [['reference', column.querySelector('img')], ['submission', cell.querySelector('.test')],
    ['difference', cell.querySelector('.heat')]];
  dialog.querySelector('.three').replaceChildren(...pictures.filter(([, img]) => img).map(([name, img]) => {
    const figure = document.createElement('figure'), caption = document.createElement('figcaption');
    const copy = new Image();
    copy.src = img.src;
    copy.alt = caption.textContent = name;
    figure.append(caption, copy);
    return figure;
  }));
  dialog.showModal();
};
dialog.querySelector('button').onclick = () => dialog.close();
const failed = document.querySelector('#failed');
failed.onchange = () => {
  for (const row of document.querySelectorAll('tbody tr')) row.hidden = failed.checked && 'good' in row.dataset;
};
)js";

std::string pointsText(double points) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2f", points);
  std::string result = text;
  while (result.back() == '0') result.pop_back();
  if (result.back() == '.') result.pop_back();
  return result;
}

/// The start of a text, as far as a cell has room.
std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 90;
  if (text.size() <= kMost) return text;
  std::size_t end = text.rfind(' ', kMost);
  if (end == text.npos) end = kMost;
  while (end > 0 && (text[end] & 0xC0) == 0x80) --end;  // whole characters
  return text.substr(0, end) + " ...";
}

/// The words of a cell: the mistakes, why there is no picture, or the verdict.
std::string cellText(const GradedPair& pair) {
  std::string text;
  for (const std::string& mistake : pair.mistakes) text += (text.empty() ? "" : ", ") + mistake;
  if (!text.empty()) return text;
  const bool hasReason =
      pair.verdict == Verdict::missing || (pair.verdict == Verdict::unreadable && pair.cpu >= 0);
  return hasReason && !pair.problem.empty() ? shortened(pair.problem)
                                            : std::string(verdictText(pair.verdict));
}

/// "1.24 s", "9 ms".
std::string secondsText(double seconds) {
  char text[40];
  seconds < 1 ? std::snprintf(text, sizeof text, "%.0f ms", 1000 * seconds)
              : std::snprintf(text, sizeof text, "%.2f s", seconds);
  return text;
}

/// "1.24 s (Trace 510 ms)"; "" if no program was run.
std::string timeText(const GradedPair& pair) {
  if (pair.cpu < 0) return "";
  return secondsText(pair.cpu) + (pair.ourCpu < 0 ? "" : " (Trace " + secondsText(pair.ourCpu) + ")");
}

std::string detailText(const ClassTask& task, const ClassStudent& student, const GradedPair& pair) {
  std::string text(verdictText(pair.verdict));
  if (!pair.cause.empty()) text += "\n" + pair.cause;
  if (!pair.problem.empty())
    text = pair.problem.starts_with(text) ? pair.problem : text + "\n" + pair.problem;
  if (pair.cpu >= 0) text += "\nprocessor time " + timeText(pair);
  for (std::size_t i = 0; i < pair.values.size(); ++i) {
    char number[40];
    std::snprintf(number, sizeof number, "%.4g", pair.values[i]);
    text += (i == 0 ? "\n" : ", ") + std::string(metrics()[i].name) + " " + number;
  }
  if (!pair.file.empty()) text += "\n" + task.grade.folder + "/" + student.name + "/" + pair.file;
  return text;
}

std::string cellHtml(const ClassTask& task, const ClassStudent& student, std::size_t i) {
  const GradedPair& pair = student.pairs[i];
  const bool good = passes(pair.verdict);
  std::string html = "<td data-title=\"" + escaped(student.name + ", " + pair.name) + "\" data-text=\"" +
                     escaped(detailText(task, student, pair)) + "\">";
  if (good) html += "<div class=\"same s" + std::to_string(i) + "\"></div>";
  if (!pair.testPicture.empty())
    html += "<img class=\"test\" alt=\"\" src=\"" + dataAddress("jpeg", pair.testPicture) + "\">";
  if (!pair.heatPicture.empty())
    html += "<img class=\"heat\" alt=\"\" hidden src=\"" + dataAddress("jpeg", pair.heatPicture) + "\">";
  return html + "<span class=\"" + (good ? "good" : "bad") + "\">" + "<b>" + pointsText(student.points[i]) +
         "</b> " + escaped(cellText(pair)) + "</span>" +
         (pair.cpu < 0 ? "" : "<span class=\"faint\">" + timeText(pair) + "</span>") + "</td>";
}

/// In one line: tools that read lines take a line break inside quotes for the end of a row.
std::string inOneLine(const std::string& text) {
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    if (end > at) line += (line.empty() ? "" : "; ") + text.substr(at, end - at);
    at = end + 1;
  }
  return line;
}

std::string csvField(const std::string& given) {
  std::string text = inOneLine(given);
  if (!text.empty() && std::string_view("=+-@\t").find(text[0]) != std::string_view::npos)
    text.insert(0, "'");
  if (text.find_first_of(",\"") == text.npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// The files of students that are compared with nothing.
std::string extraHtml(const ClassGrades& grades) {
  std::string files;
  for (const ClassStudent& student : grades.students)
    for (const std::string& file : student.extra)
      files += (files.empty() ? " " : ", ") + escaped(student.name + "/" + file);
  std::string html = files.empty() ? "" : "<p class=\"faint\">Without a reference:" + files + "</p>\n";
  for (const ClassStudent& student : grades.students)
    for (const PassedOver& file : student.passedOver)
      html += "<p class=\"faint\">" + escaped(student.name + "/" + passedOverText(file)) + "</p>\n";
  return html;
}

}  // namespace

std::string classPage(const ClassTask& task, const ClassGrades& grades) {
  const std::string title = "Class " + task.grade.folder + " against " + task.grade.reference;
  std::string style = std::string(kPageColors) + std::string(kClassStyle), head;
  for (std::size_t i = 0; i < grades.scenes.size(); ++i) {
    const ClassScene& scene = grades.scenes[i];
    head += "<th>" + escaped(scene.name) + " (" + pointsText(scene.points) + ")";
    if (!scene.thumbnail.empty()) {
      const std::string address = dataAddress("jpeg", scene.thumbnail);
      head += "<img alt=\"" + escaped(scene.name) + "\" src=\"" + address + "\">";
      style += ".s" + std::to_string(i) + " { height: 60px; background-image: var(--s" + std::to_string(i) +
               "); }\n";
      style += ":root { --s" + std::to_string(i) + ": url(" + address + "); }\n";
    }
    head += "</th>";
  }
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      escaped(title) + "</title>\n<style>" + style + "</style></head>\n<body>\n<h1>" + escaped(title) +
      "</h1>\n<p>" + counted(grades.students.size(), "student") + ", " +
      counted(grades.scenes.size(), "scene") + ", " + pointsText(grades.possible) +
      " points. Worst first.</p>\n<p class=\"faint\">A cell has the points and the cause of a difference; "
      "click "
      "on it for the numbers. A picture within the limits is shown pale. Made by Trace " TRACE_VERSION
      ".</p>\n";
  if (!grades.stopped.empty())
    html += "<p class=\"bad\">Not all was compared: " + escaped(grades.stopped) + "</p>\n";
  html +=
      "<p><label><input type=\"checkbox\" id=\"failed\"> only students with a picture beyond the limits"
      "</label></p>\n<table><thead><tr><th>student</th><th>points</th>" +
      head + "</tr></thead>\n<tbody>\n";
  for (const ClassStudent& student : grades.students) {
    html += std::string("<tr") + (student.passed == student.pairs.size() ? " data-good" : "") + "><th>" +
            escaped(student.name) + "</th><td class=\"points\">" + pointsText(student.total) + "</td>";
    for (std::size_t i = 0; i < student.pairs.size(); ++i) html += cellHtml(task, student, i);
    html += "</tr>\n";
  }
  return html + "</tbody></table>\n" + extraHtml(grades) +
         "<dialog aria-label=\"one picture\"><h2></h2><div "
         "class=\"three\"></div><pre></pre>"
         "<button>Close</button></dialog>\n<script>" +
         std::string(kClassScript) + "</script></body></html>\n";
}

std::string classCsv(const ClassGrades& grades) {
  std::string text = "student,points,of";
  for (const ClassScene& scene : grades.scenes)
    for (const char* column : {" points", " verdict", " cause", " cpu", " cpu of Trace"})
      text += "," + csvField(scene.name + column);
  text += "\r\n";
  for (const ClassStudent& student : grades.students) {
    text += csvField(student.name) + "," + pointsText(student.total) + "," + pointsText(grades.possible);
    for (std::size_t i = 0; i < student.pairs.size(); ++i) {
      const GradedPair& pair = student.pairs[i];
      text += "," + pointsText(student.points[i]) + "," + std::string(verdictText(pair.verdict)) + "," +
              csvField(pair.cause.empty() ? pair.problem : pair.cause);
      for (const double seconds : {pair.cpu, pair.ourCpu}) text += "," + (seconds < 0 ? "" : toText(seconds));
    }
    text += "\r\n";
  }
  return text;
}

}  // namespace trace
