import { defineConfig } from 'vite';
import { oneFile } from './one_file.ts';

export default defineConfig({
  base: '/',
  publicDir: false,
  plugins: [oneFile],
  build: {
    outDir: '../page',
    emptyOutDir: true,
    target: 'es2022',
    sourcemap: false,
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 2000,
    rolldownOptions: {
      output: {
        codeSplitting: false,
        entryFileNames: 'page.js',
        assetFileNames: 'page.[ext]',
      },
    },
  },
});
