"use strict";
/* Elements of a page and their words. Text is set as text, never as markup. */

const at = (id) => document.getElementById(id);
const element = (kind, text, options = {}) => Object.assign(document.createElement(kind), { textContent: text }, options);
const styleOf = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const whole = (value) => (value === null ? "\u2013" : value.toLocaleString("en-US", { maximumFractionDigits: 0 }));
const counted = (count, word) => `${whole(count)} ${word}${count === 1 ? "" : "s"}`;
