"use strict";

// What drawings are made with: the same calls draw on a canvas, for motion, and into an SVG file, for paper.
// Coordinates are pixels, y downwards. A style has fill, stroke, width, dash, opacity; `closed` closes a path.

class CanvasPen {
  constructor(context, width, height) {
    this.context = context;
    this.width = width;
    this.height = height;
  }

  begin(background) {
    const c = this.context;
    c.globalAlpha = 1;
    c.clearRect(0, 0, this.width, this.height);
    if (background) {
      c.fillStyle = background;
      c.fillRect(0, 0, this.width, this.height);
    }
    c.lineJoin = c.lineCap = "round";
  }

  path(points, style) {
    if (points.length < 2) return;
    const c = this.context;
    c.beginPath();
    c.moveTo(points[0][0], points[0][1]);
    for (let i = 1; i < points.length; i++) c.lineTo(points[i][0], points[i][1]);
    if (style.closed) c.closePath();
    this.paint(style);
  }

  circle(centre, radius, style) {
    this.context.beginPath();
    this.context.arc(centre[0], centre[1], Math.max(radius, 0), 0, 2 * Math.PI);
    this.paint(style);
  }

  paint(style) {
    const c = this.context;
    c.globalAlpha = style.opacity ?? 1;
    if (style.fill) {
      c.fillStyle = style.fill;
      c.fill();
    }
    if (style.stroke) {
      c.strokeStyle = style.stroke;
      c.lineWidth = style.width ?? 1;
      c.setLineDash(style.dash ?? []);
      c.stroke();
    }
    c.globalAlpha = 1;
  }

  text(at, text, style) {
    const c = this.context;
    c.font = `${style.size ?? 12}px system-ui, sans-serif`;
    c.textAlign = style.align ?? "left";
    c.textBaseline = "middle";
    if (style.halo) {
      c.strokeStyle = style.halo;
      c.lineWidth = 3;
      c.setLineDash([]);
      c.strokeText(text, at[0], at[1]);
    }
    c.fillStyle = style.fill;
    c.fillText(text, at[0], at[1]);
  }
}

class SvgPen {
  constructor(width, height) {
    this.width = width;
    this.height = height;
    this.parts = [];
  }

  begin(background) {
    this.parts = background ? [`<rect width="${this.width}" height="${this.height}" fill="${background}"/>`] : [];
  }

  path(points, style) {
    if (points.length < 2) return;
    const d = points.map(([x, y], i) => `${i ? "L" : "M"}${short(x)} ${short(y)}`).join("") + (style.closed ? "Z" : "");
    this.parts.push(`<path d="${d}"${this.style(style)}/>`);
  }

  circle(centre, radius, style) {
    const [x, y] = centre.map(short);
    this.parts.push(`<circle cx="${x}" cy="${y}" r="${short(Math.max(radius, 0))}"${this.style(style)}/>`);
  }

  style(style) {
    let out = ` fill="${style.fill ?? "none"}"`;
    if (style.stroke) out += ` stroke="${style.stroke}" stroke-width="${style.width ?? 1}"`;
    if (style.stroke && style.dash?.length) out += ` stroke-dasharray="${style.dash.join(" ")}"`;
    if (style.opacity != null && style.opacity !== 1) out += ` opacity="${style.opacity}"`;
    return out;
  }

  text(at, text, style) {
    const anchor = { left: "start", center: "middle", right: "end" }[style.align ?? "left"];
    const halo = style.halo ? ` stroke="${style.halo}" stroke-width="3" paint-order="stroke"` : "";
    this.parts.push(
      `<text x="${short(at[0])}" y="${short(at[1])}" font-size="${style.size ?? 12}" text-anchor="${anchor}"` +
        ` dominant-baseline="central" fill="${style.fill}"${halo}>${escapeXml(text)}</text>`,
    );
  }

  finish() {
    return (
      `<svg xmlns="http://www.w3.org/2000/svg" width="${this.width}" height="${this.height}" ` +
      `viewBox="0 0 ${this.width} ${this.height}" font-family="system-ui, sans-serif" stroke-linejoin="round" ` +
      `stroke-linecap="round">\n${this.parts.join("\n")}\n</svg>\n`
    );
  }
}

function short(x) {
  return String(Math.round(100 * x) / 100);
}

function escapeXml(text) {
  const names = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&#39;" };
  return String(text).replace(/[&<>"']/g, (c) => names[c]);
}

if (typeof module !== "undefined") module.exports = { CanvasPen, SvgPen, escapeXml };
