// The page of `ray grade`: one HTML file with its style, its script and its pictures inside. Without scripts
// it is a table with pictures; the script adds sorting, a filter and the viewer.
#include <cmath>
#include <cstdio>

#include "app/compare/grade.h"
#include "base/base64.h"
#include "base/text.h"

namespace trace {
namespace {

constexpr std::string_view kStyle = R"css(
:root { color-scheme: light dark; --ground: #fbfbfa; --ink: #1c1c1a; --faint: #6b6b66; --line: #d9d9d4;
  --card: #fff; --bad: #b3261e; --good: #1b6e3a; --accent: #0b57b7; }
@media (prefers-color-scheme: dark) { :root { --ground: #161615; --ink: #ececea; --faint: #a0a09a; --line: #3a3a37;
  --card: #1f1f1d; --bad: #ff8a80; --good: #7ddb9b; --accent: #8ab8ff; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem; max-width: 90rem; background: var(--ground); color: var(--ink);
  font: 15px/1.45 system-ui, sans-serif; }
h1 { font-size: 1.4rem; margin: 0 0 .3rem; }
p { margin: .2rem 0; } .faint { color: var(--faint); }
button, select, input, label { font: inherit; color: inherit; }
button { background: none; border: 1px solid var(--line); border-radius: .4rem; padding: .15rem .6rem; cursor: pointer; }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; margin-top: 1rem; background: var(--card); }
th, td { border-bottom: 1px solid var(--line); padding: .4rem .5rem; text-align: left; vertical-align: middle; }
th { white-space: nowrap; }
th button { border: 0; padding: 0; font-weight: 600; }
th[aria-sort=ascending] button::after { content: " \2191"; } th[aria-sort=descending] button::after { content: " \2193"; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
td.pictures { white-space: nowrap; }
td img { height: 64px; width: auto; margin-right: .3rem; vertical-align: middle; background: #888; }
.verdict { font-weight: 600; white-space: nowrap; } .bad { color: var(--bad); } .good { color: var(--good); }
pre { margin: .2rem 0; white-space: pre-wrap; font-size: .85rem; }
dialog { width: min(96vw, 100rem); max-width: none; height: 94vh; padding: 1rem; border: 1px solid var(--line); border-radius: .6rem;
  background: var(--card); color: var(--ink); }
dialog[open] { display: flex; flex-direction: column; gap: .6rem; } dialog::backdrop { background: #000a; }
.bar { display: flex; flex-wrap: wrap; gap: .4rem 1rem; align-items: center; } .bar h2 { font-size: 1.1rem; margin: 0; flex: 1; }
.stage { flex: 1; min-height: 0; overflow: auto; display: flex; gap: 1rem; }
.frame { position: relative; margin: auto; touch-action: none; } .frame img { display: block; image-rendering: pixelated; }
figure { margin: auto; } figcaption { color: var(--faint); }
.swipe { cursor: ew-resize; } .swipe .over { position: absolute; inset: 0; }
.swipe .edge { position: absolute; top: 0; bottom: 0; width: 2px; margin-left: -1px; background: #fff; box-shadow: 0 0 0 1px #000; }
.swipe .side { position: absolute; top: .3rem; padding: 0 .4rem; background: #000a; color: #fff; font-size: .8rem; pointer-events: none; }
input[type=range] { width: 100%; accent-color: var(--accent); }
)css";

constexpr std::string_view kScript = R"js(
'use strict';
const $ = (query, from = document) => from.querySelector(query);
const rows = [...document.querySelectorAll('tbody tr')], dialog = $('dialog'), stage = $('.stage');
let open = -1;

// --- table: sorting and filter
for (const header of document.querySelectorAll('th[data-key]')) {
  $('button', header).onclick = () => {
    const now = header.getAttribute('aria-sort'), worstIsLast = !['name', 'verdict', 'psnr'].includes(header.dataset.key);
    const up = now ? now === 'descending' : !worstIsLast;
    for (const other of document.querySelectorAll('th')) other.removeAttribute('aria-sort');
    header.setAttribute('aria-sort', up ? 'ascending' : 'descending');
    const value = row => row.dataset[header.dataset.key];
    const order = (a, b) => header.dataset.key === 'name' ? value(b).localeCompare(value(a)) : value(b) - value(a);
    rows.sort((a, b) => up ? -order(a, b) : order(a, b));
    $('tbody').append(...rows);
  };
}
$('#failed').onchange = event => {
  for (const row of rows) row.hidden = event.target.checked && 'good' in row.dataset;
};

// --- viewer
const picture = (row, kind) => $(`img[data-kind=${kind}]`, row)?.src;
function image(source, alt) {
  const img = new Image();
  img.alt = alt;
  img.onload = () => resize(img);
  img.src = source;
  return img;
}
function resize(img) {
  const zoom = $('#zoom').value, pair = mode() === 'side' ? 2.1 : 1;
  const fit = Math.min((stage.clientWidth - 16) / img.naturalWidth / pair, (stage.clientHeight - 32) / img.naturalHeight);
  img.style.width = img.naturalWidth * (zoom === 'fit' ? fit : +zoom) + 'px';
}
const mode = () => $('input[name=mode]:checked').value;
function moveSwipe() {
  const share = $('#share').value, over = $('.over', stage);
  if (!over) return;
  over.style.clipPath = `inset(0 0 0 ${share}%)`;
  $('.edge', stage).style.left = share + '%';
}
function element(name, className, ...children) {
  const made = document.createElement(name);
  made.className = className;
  made.append(...children);
  return made;
}
function figure(row, kind, text) {
  return element('figure', '', element('figcaption', '', text), element('div', 'frame', image(picture(row, kind), text)));
}
function swipe(row) {
  const over = image(picture(row, 'test'), 'result');
  over.className = 'over';
  const left = element('span', 'side', 'reference'), right = element('span', 'side', 'result');
  left.style.left = right.style.right = '.3rem';
  const frame = element('div', 'frame swipe', image(picture(row, 'reference'), 'reference'), over,
    element('div', 'edge'), left, right);
  const follow = event => {
    if (!event.buttons) return;
    const box = frame.getBoundingClientRect();
    $('#share').value = 100 * (event.clientX - box.left) / box.width;
    moveSwipe();
  };
  frame.onpointerdown = event => { frame.setPointerCapture(event.pointerId); event.preventDefault(); follow(event); };
  frame.onpointermove = follow;
  return frame;
}
function draw() {
  const row = rows[open], now = mode();
  stage.replaceChildren(...(now === 'side' ? [figure(row, 'reference', 'reference'), figure(row, 'test', 'result')]
    : now === 'swipe' ? [swipe(row)] : [figure(row, now, now === 'heat' ? 'difference' : 'what an eye sees (FLIP)')]));
  $('#share').disabled = now !== 'swipe';
  moveSwipe();
}
function view(index) {
  const row = rows[index];
  if (!row || !picture(row, 'test')) return false;
  open = index;
  $('h2', dialog).textContent = row.dataset.name + ': ' + row.dataset.text;
  for (const kind of ['heat', 'flip']) $(`input[value=${kind}]`).disabled = !picture(row, kind);
  if ($('input[name=mode]:checked').disabled) $('input[value=swipe]').checked = true;
  if (!dialog.open) dialog.showModal(), $('#share').focus();
  draw();
  return true;
}
function step(by) {
  for (let i = open + by; rows[i]; i += by) if (!rows[i].hidden && view(i)) return;
}
for (const row of rows) for (const button of row.querySelectorAll('button')) button.onclick = () => view(rows.indexOf(row));
$('#previous').onclick = () => step(-1);
$('#next').onclick = () => step(1);
$('#close').onclick = () => dialog.close();
$('#share').oninput = moveSwipe;
$('#zoom').onchange = () => stage.querySelectorAll('img').forEach(resize);
addEventListener('resize', () => stage.querySelectorAll('img').forEach(resize));
for (const radio of document.querySelectorAll('input[name=mode]')) radio.onchange = draw;
dialog.onkeydown = event => {
  if (event.key === 'PageDown' || event.key === 'n') step(1);
  else if (event.key === 'PageUp' || event.key === 'p') step(-1);
  else return;
  event.preventDefault();
};
)js";

constexpr std::string_view kViewer = R"html(<dialog aria-label="compare the pictures of a pair">
<div class="bar"><h2></h2><button id="previous" title="p or Page Up">Previous</button>
<button id="next" title="n or Page Down">Next</button><button id="close" title="Escape">Close</button></div>
<div class="bar" role="radiogroup" aria-label="view">
<label><input type="radio" name="mode" value="swipe" checked> swipe</label>
<label><input type="radio" name="mode" value="side"> side by side</label>
<label><input type="radio" name="mode" value="heat"> difference</label>
<label><input type="radio" name="mode" value="flip"> FLIP</label>
<label>zoom <select id="zoom"><option value="fit">fit<option value="1">1:1<option value="2">2:1<option value="4">4:1<option value="8">8:1</select></label></div>
<div class="stage"></div>
<label>reference | result <input type="range" id="share" min="0" max="100" step="0.5" value="50"></label>
</dialog>
)html";

std::string escaped(std::string_view text) {
  std::string result;
  for (char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string shortNumber(double value) {
  if (std::isinf(value)) return "\u221e";
  char text[40];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string thumbnail(const char* kind, const char* type, const std::string& bytes, const std::string& name) {
  if (bytes.empty()) return "";
  return "<img data-kind=\"" + std::string(kind) + "\" alt=\"" + std::string(kind) + " of " + escaped(name) +
         "\" src=\"data:image/" + std::string(type) + ";base64," + toBase64(bytes) + "\">";
}

std::string summaryText(const GradedPair& pair) {
  std::string text(verdictText(pair.verdict));
  for (std::size_t i = 0; i < pair.values.size(); ++i) {
    const std::string_view name = metrics()[i].name;
    if (name == "flip" || name == "rmse")
      text += ", " + std::string(name) + " " + shortNumber(pair.values[i]);
  }
  return text;
}

std::string rowHtml(const GradedPair& pair) {
  const bool good = passes(pair.verdict);
  std::string html = "<tr data-name=\"" + escaped(pair.name) + "\" data-verdict=\"" +
                     std::to_string(static_cast<int>(pair.verdict)) + "\" data-text=\"" +
                     escaped(summaryText(pair)) + "\"" + (good ? " data-good" : "");
  for (std::size_t i = 0; i < pair.values.size(); ++i)
    html +=
        " data-" + std::string(metrics()[i].name) + "=\"" + toText(std::min(pair.values[i], 1e300)) + "\"";
  html += "><td class=\"verdict " + std::string(good ? "good" : "bad") + "\">" +
          std::string(verdictText(pair.verdict)) + "</td><td>";
  const bool viewable = !pair.testPicture.empty();
  html += viewable ? "<button>" + escaped(pair.name) + "</button>" : escaped(pair.name);
  if (!pair.problem.empty()) html += "<pre>" + escaped(pair.problem) + "</pre>";
  if (!pair.cause.empty()) html += "<pre>" + escaped(pair.cause) + "</pre>";
  html += "</td><td class=\"pictures\">" + thumbnail("reference", "png", pair.referencePicture, pair.name) +
          thumbnail("test", "png", pair.testPicture, pair.name) +
          thumbnail("heat", "jpeg", pair.heatPicture, pair.name) +
          thumbnail("flip", "jpeg", pair.flipPicture, pair.name) + "</td>";
  for (std::size_t i = 0; i < metrics().size(); ++i)
    html += "<td class=\"number\">" + (pair.values.empty() ? "" : shortNumber(pair.values[i])) + "</td>";
  return html + "</tr>\n";
}

std::string limitsText(const GradeTask& task) {
  std::string text;
  for (const Limit& limit : task.limits)
    text += (text.empty() ? "" : ", ") + std::string(limit.metric->name) +
            (limit.metric->higherIsBetter ? " at least " : " at most ") + toText(limit.value);
  return text.empty() ? "no value beyond the tolerance" : text;
}

}  // namespace

std::string gradePage(const GradeTask& task, const Grades& grades) {
  const std::string title = "Pictures of " + task.folder + " against " + task.reference;
  const std::size_t all = grades.pairs.size();
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      escaped(title) + "</title>\n<style>" + std::string(kStyle) + "</style></head>\n<body>\n<h1>" +
      escaped(title) + "</h1>\n<p><b class=\"" + (grades.passed == all ? "good" : "bad") + "\">" +
      std::to_string(grades.passed) + " of " + std::to_string(all) +
      "</b> within the limits: " + escaped(limitsText(task)) + "; tolerance " +
      toText(task.difference.tolerance) +
      ".</p>\n<p class=\"faint\">Worst first. Thumbnails: reference, result, "
      "difference times " +
      toText(task.magnify) +
      ", the perceived difference (FLIP). The name of a pair opens it. Made by Trace " TRACE_VERSION
      ".</p>\n"
      "<p><label><input type=\"checkbox\" id=\"failed\"> only those not within the limits</label></p>\n"
      "<div class=\"wide\"><table><thead><tr><th data-key=\"verdict\"><button>verdict</button></th>"
      "<th data-key=\"name\"><button>picture</button></th><th>reference, result, difference, FLIP</th>";
  for (const Metric& metric : metrics())
    html += "<th class=\"number\" data-key=\"" + std::string(metric.name) + "\"><button title=\"" +
            escaped(metric.help) + "\">" + std::string(metric.name) +
            (metric.unit.empty() || metric.name == "flip" ? "" : " " + std::string(metric.unit)) +
            "</button></th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const GradedPair& pair : grades.pairs) html += rowHtml(pair);
  html += "</tbody></table></div>\n";
  if (!grades.extra.empty()) {
    html += "<p class=\"faint\">Without a reference:";
    for (const std::string& file : grades.extra) html += " " + escaped(file);
    html += "</p>\n";
  }
  return html + std::string(kViewer) + "<script>" + std::string(kScript) + "</script></body></html>\n";
}

}  // namespace trace
