"use strict";
/* The text of the scene, with numbers of its lines and an error at its place. */

/* "scene:3:14: what is wrong": line, column and words; a line of 0 where the message names none. */
function placeOf(message) {
  const [, line, column, words] = message.match(/^scene:(\d+):(\d+): ([^]*)$/) || [null, "0", "0", message];
  return { line: Number(line), column: Number(column), words };
}

function numberLines(wrong) {
  const count = at("text").value.split("\n").length;
  at("numbers").replaceChildren(...Array.from({ length: count }, (_, k) => {
    return [element(k + 1 === wrong ? "b" : "span", k + 1), "\n"];
  }).flat());
  at("numbers").scrollTop = at("text").scrollTop;
}

/* The line with the place below it, and the words. */
function showTrouble(message) {
  at("trouble").hidden = message === null;
  const { line, column, words } = message === null ? { line: 0 } : placeOf(message);
  numberLines(line);
  if (message === null) return;
  const source = at("text").value.split("\n")[line - 1];
  at("trouble").textContent = source === undefined ? words
    : `line ${line}: ${words}\n\n${source}\n${" ".repeat(Math.max(0, column - 1))}^`;
}

function listenToText(changed) {
  let waiting = 0;
  at("text").addEventListener("input", () => {
    numberLines(0);
    clearTimeout(waiting);
    waiting = setTimeout(changed, 400);
  });
  at("text").addEventListener("scroll", () => { at("numbers").scrollTop = at("text").scrollTop; });
}
